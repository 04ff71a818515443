// The liquid, and all that the next step needs of it.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/markers/markers.h"

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// phi, the velocity that belongs to it (projected, extrapolated, at rest relative to solids) and the markers
// that keep phi right.
struct Liquid {
  FloatGrid::Ptr phi;           // narrow band, metres, negative inside
  Velocity velocity;            // m/s
  Markers markers;              // on both sides of the surface
  std::int64_t steps = 0;       // taken so far: the seed of the markers to come
  double leapfrogOffset = 0.0;  // s: leapfrog offset; the velocity is that of so much later than phi
  // m/s2 at the velocity's faces, extrapolated: what pressure and friction did in the last step; none where
  // there was none.
  FaceGrids acceleration;
  // K at cell centres of the velocity's leaves, extended into air and solids; null where heat is not
  // simulated.
  FloatGrid::Ptr temperature = nullptr;
  // The volume deficit, see sim/volume/volume_deficit.h; null for none.
  FloatGrid::Ptr deficit = nullptr;
  // m/s at the velocity's faces near the surface, by which the liquid grows to give back the deficit; none
  // where there is none. It moves the surface, and no momentum.
  Velocity expansion = {};
};

// A liquid at the end of a frame; writing and reading it back continues bit for bit (sim/step/state_io.h).
struct State : Liquid {
  int frame = 0;             // last finished frame, 0 before the first
  double time = 0.0;         // s
  std::vector<bool> poured;  // bodies of Options::liquid that have been put in already, by index
};

inline constexpr int kAtCentres = -1;

// visit(name, grid, axis) for each grid of a liquid, null where there is none; axis: of the faces that it
// sits at, or kAtCentres. What sets up, keeps and compares liquids walks this list: a further grid is a
// member of Liquid and a line here.
template <class AnyLiquid, class Visit>
void forEachGrid(AnyLiquid& liquid, const Visit& visit) {
  const auto faces = [&](const char* const(&names)[3], auto& grids) {
    for (int axis = 0; axis < 3; ++axis) visit(names[axis], grids.component[axis], axis);
  };
  visit("phi", liquid.phi, kAtCentres);
  faces({"u", "v", "w"}, liquid.velocity);
  faces({"au", "av", "aw"}, liquid.acceleration);
  visit("temperature", liquid.temperature, kAtCentres);
  visit("deficit", liquid.deficit, kAtCentres);
  faces({"su", "sv", "sw"}, liquid.expansion);
}

// With which the surface moves: velocity and swelling, m/s.
Velocity movingVelocity(const Liquid& liquid);

// Whether there is none.
bool isEmpty(const Liquid& liquid);

// Gives all grids the transforms of cells of width h anew: copying a grid, or writing and reading it, can
// change the last bits of its transform, and with them all that is sampled.
void setTransforms(Liquid& liquid, double h);

}  // namespace fluidtex::sim
