// The liquid's surface: phi, a narrow-band level set in metres, negative inside, at cell centres.
// Active voxels: |phi| < the grid's background and not deep in a solid. All others hold +-background.
// All functions change phi in place and need no other order than the one they are called in by the solver.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shapes.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Moves phi with the velocity for dt seconds:  d(phi)/dt + u . grad(phi) = 0. Each cell takes the value from
// where it came (semi-Lagrangian, cubic interpolation where phi is smooth near the surface), in as many
// sub-steps as moves of kMaxTrace cells ask for. Leaves are added where the surface can get to. Values
// outside the velocity's leaves stay, and those deeper in solids than kSolidLayers. visibility: of the solids
// (SolidField), null for none that are thin.
void advectPhi(FloatGrid& phi, const Velocity& velocity, const FloatGrid& solidPhi, double dt,
               const Visibility* visibility = nullptr);

// Half the width of phi's band in voxels, for steps of at most `cfl` cells.
int bandWidth(double cfl);

// How much farther from the surface the distance is made right by an iteration of reinitialize, in voxels.
inline constexpr double kReinitReach = 0.4;

// Turns phi into a signed distance near the surface, which itself stays where it is: cells next to it use its
// place between the cell centres, to fourth order where it is smooth and three cells from solids. Cells in
// solids more than half a cell deep are left alone (see extendIntoSolids).
void reinitialize(FloatGrid& phi, const FloatGrid& solidPhi, int iterations = 8,
                  const Visibility* visibility = nullptr);

// Where a surface runs along a solid with a gap between them: asked of cells in the open beside the solid.
struct GapRules {
  // Whether the gap opens: the liquid has let go of the solid, or, where the cell is air, moves away from it.
  std::function<bool(const Coord&)> opens;
  // Else, whether it closes: the liquid moves or is driven against the solid. Otherwise it stays as wide as
  // it is, as between a pool and a ceiling.
  std::function<bool(const Coord&)> closes;
};

// Gives the cells more than half a cell deep in solids, in the leaves that phi has, values such that the
// surface runs straight on into the solid, with phi's whole gradient. Not with the part along the solid's
// normal where the surface is nearly parallel to the solid and the gap between them closes (nothing else
// would close the last half cell: there the velocity is the solid's), nor where a film thinner than half a
// cell would begin that flows out of the solid. Where the gap opens, phi rises along the normal. Without
// rules everything stays as it is: a gap or a film that is there is kept, and none begins. deep: from how
// deep in a solid on, in voxels. visibility: of the solids; nothing comes through a thin one. left: the
// solids before they moved, null where they did not; cells that they have left get their values from what is
// beside them in the open, and are air where nothing is.
void extendIntoSolids(FloatGrid& phi, const FloatGrid& solidPhi, const GapRules& rules = {},
                      float deep = kDeepInSolid, const Visibility* visibility = nullptr,
                      const FloatGrid* left = nullptr);

// The same for solids and sides of the domain: beyond sides of symmetry phi is its own mirror image.
void extendBeyond(FloatGrid& phi, const SolidField& solid, const GapRules& rules = {},
                  float deep = kDeepInSolid, const FloatGrid* left = nullptr);
// reinitialize, for which sides of symmetry are no solids; the liquid goes on beyond them.
void redistance(FloatGrid& phi, const SolidField& solid, int iterations);

// Takes solids out of the liquid, phi = max(phi, -solidPhi), in the cells active in `where`.
void cutSolids(FloatGrid& phi, const FloatGrid& solidPhi, const MaskGrid& where);

// Sets the active voxels anew, clamps all others, and drops leaves without any.
void trimBand(FloatGrid& phi, const FloatGrid& solidPhi);

// phi = min(phi, distance) in the leaves that touch the box and where that is less than the background: call
// reinitialize and trimBand afterwards. All leaves that phi then has are active as a whole. distance: at
// world positions; at least its sign and a lower bound of its magnitude are right.
void unite(FloatGrid& phi, const std::function<double(const Vec3d&)>& distance, const CoordBBox& within);
// The same wherever the shape is in the domain (see domainCells) and a leaf beyond. Throws
// std::invalid_argument where it has no end. distance: to what of the shape's surface counts, all of it where
// none is given.
void unite(FloatGrid& phi, const ShapeDistance& shape, const CoordBBox& domain,
           const std::function<double(const Vec3d&)>& distance = {});

// The textured surface: liquid with solids taken out, max(phi, -solidPhi), a distance `halfWidth` voxels
// either side.
FloatGrid::Ptr visibleSurface(const FloatGrid& phi, const SolidField& solid, int halfWidth);

// Cubic metres that the surface encloses outside solids (see sim/surface/cell_volume.h).
double liquidVolume(const FloatGrid& phi, const SolidField& solid);

// Cells of the domain with phi < 0 whose centre is not in a solid.
std::int64_t liquidCells(const FloatGrid& phi, const SolidField& solid);

}  // namespace fluidtex::sim
