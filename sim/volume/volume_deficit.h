// What the surface has lost or gained of the liquid's volume, kept where that happened, carried with the flow
// and given back there. A level set alone loses films, sheets and drops thinner than its cells; a volume of
// fluid in flux form is exact in sum but not sharp. Here phi says where the surface is, the fluxes how much
// liquid there should be, and the difference is owed: it gathers in the liquid next to it and makes that grow
// or shrink (PressureOptions::growth). Conservative, and local: liquid elsewhere does not move. Coupling of
// the two after Sussman and Puckett, "A coupled level set and volume-of-fluid method for computing 3D and
// axisymmetric incompressible two-phase flows", 2000.
#pragma once

#include "sim/flows/flows.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/surface/cell_volume.h"

#include <vector>

namespace fluidtex::sim {

// What is owed after a step of dt seconds in which `velocity` moved the surface from `before` to `after`:
// cubic metres over h^3 at cell centres, negative where there is too much liquid. owed: what was before, null
// for nothing; solid: while `velocity` held. Volumes are carried by fluxes through the solids' open faces
// (sim/volume/volume_flux.h). What leaves through sides of the domain is gone; drains owe
// nothing. Sources fill their cells up again for nothing, but what meets them from outside is owed. What
// solids push aside, or come over between two steps (dt 0), is owed beside them. The sum of what the surface
// encloses (liquidVolume) and of what is owed is exact. The same bytes on any number of threads.
FloatGrid::Ptr volumeDeficit(const FloatGrid& before, const FloatGrid& after, const FloatGrid* deficit,
                             const Velocity& velocity, const SolidField& solid, const SolidField& solidAfter,
                             const RunningFlows& flows, double dt);

// How fast the liquid has to grow to give back what it owes in about `time` seconds: h^3 per second at cell
// centres, of half a cell at most.
FloatGrid::Ptr growthOf(const FloatGrid& deficit, double time);

// What the surface shows in some blocks; for where phi is changed by other than flow.
struct ShownLiquid {
  std::vector<Coord> blocks;
  std::vector<LeafShares> shares;
};
// In the blocks that the cells active in `where` lie in, and those beside.
ShownLiquid shownAround(const MaskGrid& where, const FloatGrid& phi, const SolidField& solid);
// Owes what was shown and is no more, or the other way round; what is shown and owed together stays.
void oweChange(FloatGrid& deficit, const ShownLiquid& before, const FloatGrid& phi, const SolidField& solid);

// Where most is owed: the middle of the cell that owes most, either way, of the block that does.
Vec3d placeOfMost(const FloatGrid& deficit);

// What is owed in all, m3; below 0 where there is too much liquid.
double totalDeficit(const FloatGrid& deficit);

}  // namespace fluidtex::sim
