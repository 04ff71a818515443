#include "sim/pressure/liquid_cells.h"

#include "sim/grid/leaf_patch.h"
#include "sim/grid/leaf_table.h"
#include "sim/surface/level_set.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<int>;

// Least depth of a cell in the liquid, in cells: bounds the matrix entries. The depth is bounded, and not the
// distance along each axis, so that the pressure gradient keeps its direction there.
constexpr float kLeastDepth = 1e-5f;

using Patch = LeafPatch;
constexpr auto& kStride = Patch::kStride;

Coord localOf(int offset) {
  return Coord(offset >> 6, (offset >> 3) & 7, offset & 7);
}

// Open area fractions of the faces normal to x, y and z around one block.
std::array<Patch, 3> openPatches(const SolidField& solid, const Coord& origin) {
  return {patchOf(solid.open[0].constTree(), origin), patchOf(solid.open[1].constTree(), origin),
          patchOf(solid.open[2].constTree(), origin)};
}

// A field's values around one block; `without` where there is no grid.
Patch patchOr(const FloatGrid::Ptr& grid, const Coord& origin, float without) {
  if (grid != nullptr) return patchOf(grid->constTree(), origin);
  Patch patch;
  patch.fill(without);
  return patch;
}

// Given velocities around one block, kNotGiven elsewhere.
std::array<Patch, 3> givenPatches(const SolidField& solid, const Coord& origin) {
  return {patchOr(solid.given.component[0], origin, kNotGiven),
          patchOr(solid.given.component[1], origin, kNotGiven),
          patchOr(solid.given.component[2], origin, kNotGiven)};
}

// Cells of the domain with phi < 0 and an open face whose velocity is not given.
std::vector<CellBlock> liquidBlocks(const FloatGrid& phi, const SolidField& solid) {
  const std::vector<Coord> origins = wetLeaves(phi, solid.domain);
  std::vector<CellBlock> blocks(origins.size());
  tbb::parallel_for(Range(0, static_cast<int>(blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      CellBlock& block = blocks[b];
      block.origin = origins[b];
      const FloatLeaf* leaf = phi.constTree().probeConstLeaf(block.origin);
      for (int c = 0; c < kLeafSize; ++c) {
        const Coord cell = block.origin.offsetBy(c >> 6, (c >> 3) & 7, c & 7);
        block.cells[c] = solid.domain.isInside(cell) && (leaf == nullptr || leaf->getValue(c) < 0.0f);
      }
      if (block.cells.none()) continue;
      const auto open = openPatches(solid, block.origin);
      const auto given = givenPatches(solid, block.origin);
      for (int c = 0; c < kLeafSize; ++c) {
        const int at = patchIndex(c);
        bool any = false;
        for (int a = 0; a < 3; ++a) {
          for (const int face : {at, at + kStride[a]})
            any = any || (open[a][face] > 0.0f && given[a][face] == kNotGiven);
        }
        if (!any) block.cells.reset(c);
      }
    }
  });
  std::erase_if(blocks, [](const CellBlock& block) { return block.cells.none(); });
  return blocks;
}

// Merges the blocks' sides into one list. The cells' indices counted from 0 in each block.
void gatherSides(std::vector<std::vector<LiquidSides>>& sidesIn, LiquidCells& liquid) {
  std::vector<int> first(sidesIn.size() + 1, 0);
  for (std::size_t b = 0; b < sidesIn.size(); ++b)
    first[b + 1] = first[b] + static_cast<int>(sidesIn[b].size());
  liquid.sides.resize(first.back());
  tbb::parallel_for(Range(0, static_cast<int>(sidesIn.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      std::copy(sidesIn[b].begin(), sidesIn[b].end(), liquid.sides.begin() + first[b]);
      sidesIn[b] = {};
      const int* numbers = liquid.numbering.block(liquid.blocks[b].origin);
      for (int c = 0; c < kLeafSize; ++c) {
        if (numbers[c] >= 0 && liquid.special[numbers[c]] >= 0) liquid.special[numbers[c]] += first[b];
      }
    }
  });
}

}  // namespace

bool endsAt(Side kind, const SolidField& solid, const Coord& cell, int side) {
  const int axis = side >> 1;
  return solid.sides[side] == kind &&
         cell[axis] == (side & 1 ? solid.domain.max() : solid.domain.min())[axis];
}

LiquidCells gatherLiquid(const FloatGrid& phiGrid, const SolidField& solid,
                         const std::array<const FloatTree*, 3>& velocity) {
  const FloatTree& phi = phiGrid.constTree();
  LiquidCells liquid;
  liquid.blocks = liquidBlocks(phiGrid, solid);
  liquid.numbering = CellNumbering(liquid.blocks);
  liquid.outflow.resize(liquid.numbering.size());
  liquid.special.resize(liquid.numbering.size());
  std::vector<std::vector<LiquidSides>> sidesIn(liquid.blocks.size());
  const float shallowest = -kLeastDepth * static_cast<float>(solid.voxelSize);
  tbb::parallel_for(Range(0, static_cast<int>(liquid.blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const Coord& origin = liquid.blocks[b].origin;
      const int* numbers = liquid.numbering.block(origin);
      const Patch distance = patchOf(phi, origin);
      const auto open = openPatches(solid, origin);
      const std::array<Patch, 3> speed{patchOf(*velocity[0], origin), patchOf(*velocity[1], origin),
                                       patchOf(*velocity[2], origin)};
      const std::array<Patch, 3> solidSpeed{patchOr(solid.speed.component[0], origin, 0.0f),
                                            patchOr(solid.speed.component[1], origin, 0.0f),
                                            patchOr(solid.speed.component[2], origin, 0.0f)};
      const auto given = givenPatches(solid, origin);
      for (int c = 0; c < kLeafSize; ++c) {
        if (numbers[c] < 0) continue;
        LiquidSides cell;
        double& outflow = liquid.outflow[numbers[c]];
        const int here = patchIndex(c);
        for (int s = 0; s < kSides; ++s) {
          const int axis = s >> 1, up = s & 1;
          const int face = here + up * kStride[axis];
          const int beside = up ? here + kStride[axis] : here - kStride[axis];
          const float out = up ? 1.0f : -1.0f, closed = 1.0f - open[axis][face];
          const bool isGiven = given[axis][face] != kNotGiven;
          const double outward = out * (isGiven ? given[axis][face] : speed[axis][face]);
          const double push = out * solidSpeed[axis][face];
          outflow += open[axis][face] * outward + closed * push;
          if (isGiven) {
            cell.open[s] = cell.theta[s] = 0.0f;
            continue;
          }
          cell.open[s] = open[axis][face];
          if (closed > 0.0f && endsAt(Side::symmetry, solid, origin + localOf(c), s)) continue;
          cell.closed += closed;
          cell.leaving += closed * static_cast<float>(std::max(0.0, push - outward));
          if (cell.open[s] > 0.0f && endsAt(Side::open, solid, origin + localOf(c), s)) {
            cell.theta[s] = kEdgeTheta;
            continue;
          }
          const float inside = std::min(distance[here], shallowest), outside = distance[beside];
          cell.theta[s] = cell.open[s] > 0.0f && outside >= 0.0f ? inside / (inside - outside) : 0.0f;
        }
        int& special = liquid.special[numbers[c]];
        special = cell == kAllLiquid ? -1 : static_cast<int>(sidesIn[b].size());
        if (special >= 0) sidesIn[b].push_back(cell);
      }
    }
  });
  gatherSides(sidesIn, liquid);
  if (std::find(solid.sides.begin(), solid.sides.end(), Side::open) != solid.sides.end()) {
    for (int i = 0; i < liquid.numbering.size(); ++i) {
      const Coord place = liquid.numbering.cell(i);
      for (int s = 0; s < kSides; ++s) {
        if (liquid.sidesOf(i).open[s] <= 0.0f || !endsAt(Side::open, solid, place, s)) continue;
        const double along = velocity[s >> 1]->getValue(s & 1 ? neighborOf(place, s) : place);
        liquid.edges.push_back({i, s, s & 1 ? along : -along, false});
      }
    }
  }
  return liquid;
}

}  // namespace fluidtex::sim
