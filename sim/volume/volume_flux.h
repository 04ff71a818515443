// Liquid volume of each cell after a step, by fluxes: exact in sum, but not sharp. Used by
// sim/volume/volume_deficit.h.
#pragma once

#include "sim/grid/leaf_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <array>
#include <vector>

namespace fluidtex::sim {

// Values at a leaf's faces normal to each axis: the lower face of each cell, and the upper of the last layer.
// z fastest: 9 x 8 x 8, 8 x 9 x 8 and 8 x 8 x 9.
using LeafFaces = std::array<std::array<float, (kLeafDim + 1) * kLeafDim * kLeafDim>, 3>;

// Fluxes of a step, and the volume that the cells have for them. Volumes are in cells (h^3).
struct VolumeFlux {
  LeafTable leaves;             // of the flat arrays below, 512 values a leaf
  std::vector<float> open;      // open volume of each cell, 0 in solids
  std::vector<float> room;      // the same, but enlarged in slivers to hold all that flows out of them
  std::vector<LeafFaces> flux;  // of volume through each face in a sub-step, upwards
  std::vector<float> swept;  // by solids that move into the cell, in a sub-step; empty where all are at rest
  std::vector<float> phi;    // at the middle of the step, in cells
  int steps = 1;             // sub-steps: so many that no face passes more than a cell holds
};

// Fluxes of a step of dt seconds in which `velocity` moves the surface from `before` to `after`, on these
// leaves. solid: while the velocity holds.
VolumeFlux volumeFlux(LeafTable leaves, const FloatGrid& before, const FloatGrid& after,
                      const Velocity& velocity, const SolidField& solid, double dt);

// Open volume of each cell, in h^3; 0 in solids.
std::vector<float> openRoom(const SolidField& solid, const LeafTable& leaves);

// Liquid share of each cell's open part.
std::vector<float> wetShares(const FloatGrid& phi, const SolidField& solid, const LeafTable& leaves);

// The share of its open part to which a source keeps a cell filled.
struct FilledCell {
  std::size_t cell;
  float share;
  bool atLeast;  // what flows in from elsewhere may fill it further
};

// Shares at the end of a step, and the volume that solids have swept into each cell: it counts in the shares,
// but is no inflow.
struct CarriedShares {
  std::vector<float> share, swept;  // `swept` is empty where all solids are at rest
};

// Shares after the step. The sum over share times room, minus `swept`, changes only by what crosses the
// leaves' outline and by what sources add.
CarriedShares carried(const VolumeFlux& flux, std::vector<float> shares,
                      const std::vector<FilledCell>& sources = {});

}  // namespace fluidtex::sim
