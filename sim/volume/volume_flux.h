// How much liquid there is in each cell after a step, by fluxes: exact in sum, but not sharp. The other half
// of sim/volume/volume_deficit.h.
#pragma once

#include "sim/grid/leaf_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <array>
#include <vector>

namespace fluidtex::sim {

// Values at a leaf's faces normal to each axis, the lower of each cell and the upper of the last layer; z
// fastest: 9 x 8 x 8, 8 x 9 x 8 and 8 x 8 x 9.
using LeafFaces = std::array<std::array<float, (kLeafDim + 1) * kLeafDim * kLeafDim>, 3>;

// What flows in a step, and into how much room. Volumes are in cells (h^3).
struct VolumeFlux {
  LeafTable leaves;             // the flat arrays below are theirs, 512 values a leaf
  std::vector<float> open;      // open share of each cell's volume, 0 in solids
  std::vector<float> room;      // the same, but slivers have room for all that flows out of them
  std::vector<LeafFaces> flux;  // of volume through each face in a sub-step, upwards
  std::vector<float> swept;  // by solids that move into the cell, in a sub-step; empty where all are at rest
  std::vector<float> phi;    // half way through the step, in cells
  int steps = 1;             // sub-steps: so many that through no face goes more than a cell holds
};

// Of a step of dt seconds in which `velocity` moves the surface from `before` to `after`, on these leaves.
// solid: while the velocity holds.
VolumeFlux volumeFlux(LeafTable leaves, const FloatGrid& before, const FloatGrid& after,
                      const Velocity& velocity, const SolidField& solid, double dt);

// The open share of each cell's volume, 0 in solids.
std::vector<float> openRoom(const SolidField& solid, const LeafTable& leaves);

// The share of each cell's open part that phi makes liquid.
std::vector<float> wetShares(const FloatGrid& phi, const SolidField& solid, const LeafTable& leaves);

// What a source keeps a cell filled to: the share of the cell's open part.
struct FilledCell {
  std::size_t cell;
  float share;
  bool atLeast;  // what flows in from elsewhere may fill it further
};

// The shares at the step's end, and what solids have swept into each cell, which counts in the shares but has
// not come from anywhere.
struct CarriedShares {
  std::vector<float> share, swept;  // `swept` is empty where all solids are at rest
};

// The sum over share times room less `swept` changes by what crosses the leaves' outline, and by what sources
// put in, only.
CarriedShares carried(const VolumeFlux& flux, std::vector<float> shares,
                      const std::vector<FilledCell>& sources = {});

}  // namespace fluidtex::sim
