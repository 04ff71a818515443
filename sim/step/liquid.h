// State of the liquid: all that the next step needs.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/markers/markers.h"

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// phi, the velocity at its time (projected, extrapolated, constrained at solids), and the markers that
// correct phi.
struct Liquid {
  FloatGrid::Ptr phi;           // narrow band, metres, negative inside
  Velocity velocity;            // m/s
  Markers markers;              // on both sides of the surface
  std::int64_t steps = 0;       // taken so far; seeds the new markers
  double leapfrogOffset = 0.0;  // s: leapfrog offset, by which the velocity is later than phi
  // m/s2 at the velocity's faces, extrapolated: acceleration by pressure and viscosity in the last step, as
  // if that had been as long as the next one where it was shorter; no grids where there was none.
  FaceGrids acceleration;
  // K at cell centres of the velocity's leaves, extrapolated into air and solids; null where heat is not
  // simulated.
  FloatGrid::Ptr temperature = nullptr;
  // 0 to 1, where and how far as the temperature: which of a scene's liquids it is, or how they are mixed.
  // Null where all are alike.
  FloatGrid::Ptr mixture = nullptr;
  // The volume deficit, see sim/volume/volume_deficit.h; null for none.
  FloatGrid::Ptr deficit = nullptr;
  // m/s at the velocity's faces near the surface: the flow that gives the deficit back; no grids where there
  // is none. It moves the surface, but carries no momentum.
  Velocity expansion = {};
};

// The liquid at the end of a frame. A state that is written and read back continues bit for bit
// (sim/step/state_io.h).
struct State : Liquid {
  int frame = 0;             // last finished frame, 0 before the first
  double time = 0.0;         // s
  std::vector<bool> poured;  // bodies of Options::liquid poured so far, by index
};

inline constexpr int kAtCentres = -1;

// Calls visit(name, grid, axis) for each grid of a liquid, null where there is none. axis: of the faces at
// which it sits, or kAtCentres. Set-up, storage and comparison of liquids use this list: a further grid is a
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
  visit("mixture", liquid.mixture, kAtCentres);
  visit("deficit", liquid.deficit, kAtCentres);
  faces({"su", "sv", "sw"}, liquid.expansion);
}

// Velocity that moves the surface: velocity plus expansion, m/s.
Velocity movingVelocity(const Liquid& liquid);

// Whether there is no liquid.
bool isEmpty(const Liquid& liquid);

// Resets the transforms of all grids to those of cells of width h. Copying a grid, or writing and reading it,
// can change the last bits of its transform, and with them all sampled values.
void setTransforms(Liquid& liquid, double h);

}  // namespace fluidtex::sim
