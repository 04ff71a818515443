#include "sim/pressure/update_faces.h"

#include "sim/solids/solid_layers.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

using Range = tbb::blocked_range<int>;

// A face whose solid lies within about 25 degrees of square to it takes the solid's normal velocity.
constexpr float kSquare = 0.9f;

// Leaves of `grid` that hold a face of a liquid cell; missing ones are made. They are the same for every
// axis, so that the components keep one topology.
std::vector<FloatLeaf*> faceLeaves(const LiquidCells& liquid, FloatGrid& grid) {
  std::vector<FloatLeaf*> leaves;
  for (const CellBlock& block : liquid.blocks) {
    leaves.push_back(grid.tree().touchLeaf(block.origin));
    for (int axis = 0; axis < 3; ++axis) {
      Coord next = block.origin;
      next[axis] += kLeafDim;
      leaves.push_back(grid.tree().touchLeaf(next));
    }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const FloatLeaf* a, const FloatLeaf* b) { return a->origin() < b->origin(); });
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

}  // namespace

double projectedOutflow(const LiquidCells& liquid, const SurfacePressure& surface,
                        const std::vector<double>& q, int number) {
  const LiquidSides& cell = liquid.sidesOf(number);
  const Coord place = liquid.numbering.cell(number);
  double outflow = liquid.outflow[number];
  for (int s = 0; s < kSides; ++s) {
    if (cell.open[s] <= 0.0f) continue;
    const bool ends = cell.theta[s] > 0.0f;
    const int neighbor = ends ? -1 : liquid.numbering.at(neighborOf(place, s));
    const double step = (neighbor < 0 ? surface.at(number, s) : q[neighbor]) - q[number];
    outflow -= cell.open[s] * (ends ? step / cell.theta[s] : step);
  }
  return outflow;
}

MaskGrid::Ptr updateFaces(const LiquidCells& liquid, const SurfacePressure& surface, const SolidField& solid,
                          const std::vector<double>& q, const std::vector<char>& detached, int axis,
                          FloatGrid& grid) {
  const FloatGrid* const solidSpeed = solid.speed.component[axis].get();
  const FloatGrid* const given = solid.given.component[axis].get();
  const FloatGrid& open = solid.open[axis];
  auto valid = MaskGrid::create();
  valid->setTransform(faceTransform(solid.voxelSize, axis));
  const std::vector<FloatLeaf*> leaves = faceLeaves(liquid, grid);
  std::vector<MaskGrid::TreeType::LeafNodeType*> masks;
  masks.reserve(leaves.size());
  for (const FloatLeaf* leaf : leaves) masks.push_back(valid->tree().touchLeaf(leaf->origin()));

  tbb::parallel_for(Range(0, static_cast<int>(leaves.size())), [&](const Range& range) {
    const openvdb::tree::ValueAccessor<const FloatTree> distance(solid.phi->constTree());
    const auto isOpen = [&](const Coord& face) { return open.constTree().getValue(face) > 0.0f; };
    for (int n = range.begin(); n < range.end(); ++n) {
      FloatLeaf& leaf = *leaves[n];
      const BlockNumbers numbers(liquid.numbering, leaf.origin());
      for (int c = 0; c < kLeafSize; ++c) {
        const int upper = numbers.at(c), lower = numbers.beside(c, 2 * axis);
        if (upper < 0 && lower < 0) continue;

        const LiquidSides& cell = liquid.sidesOf(upper >= 0 ? upper : lower);
        const int side = 2 * axis + (upper >= 0 ? 0 : 1);
        const Coord wetCell = liquid.numbering.cell(upper >= 0 ? upper : lower);
        const bool edge = endsAt(Side::open, solid, wetCell, side);
        if (cell.open[side] > 0.0f) {
          // A nozzle: all that enters the cell would leave through this sliver, as fast as it must.
          // Extrapolation from the liquid beside it is better; at an edge only the pressure gives the
          // velocity.
          if (cell.theta[side] > 0.0f && cell.open[side] < kLeastOpen && !edge) continue;
          const double step = (upper < 0 ? surface.at(lower, side) : q[upper]) -
                              (lower < 0 ? surface.at(upper, side) : q[lower]);
          const double change = cell.theta[side] > 0.0f ? step / cell.theta[side] : step;
          leaf.setValueOn(c, static_cast<float>(leaf.getValue(c) - change));
          masks[n]->setValueOn(c);
          continue;
        }
        const Coord place = leaf.offsetToGlobalCoord(c);
        if (edge && isOpen(place)) {
          // A closed edge is no wall that liquid could separate from.
          leaf.setValueOn(c, 0.0f);
          masks[n]->setValueOn(c);
          continue;
        }
        const float slope = distance.getValue(place) - distance.getValue(neighborOf(place, 2 * axis));
        const bool solidBelow = slope > 0.0f;
        const int wet = solidBelow ? upper : lower;
        if (std::abs(slope) < kSquare * solid.voxelSize || wet < 0) continue;
        const double push = solidSpeed == nullptr ? 0.0 : solidSpeed->constTree().getValue(place);
        double away = 0.0;
        const int wall = 2 * axis + (solidBelow ? 0 : 1);
        if (detached[wet] && !endsAt(Side::symmetry, solid, liquid.numbering.cell(wet), wall)) {
          // The cell's outflow through open faces is balanced by inflow at its walls, so that it is
          // divergence-free; each wall takes a share in proportion to the speed at which liquid was about to
          // leave it.
          const auto& sides = liquid.sidesOf(wet);
          const double relative = leaf.getValue(c) - push;
          const double ready = std::max(0.0, solidBelow ? relative : -relative);
          const double share = sides.leaving > 0.0f ? ready / sides.leaving : 1.0 / sides.closed;
          away = std::max(0.0, projectedOutflow(liquid, surface, q, wet)) * share;
        }
        leaf.setValueOn(c, static_cast<float>(push + (solidBelow ? away : -away)));
        masks[n]->setValueOn(c);
      }
    }
  });
  if (given != nullptr) {
    for (auto it = given->cbeginValueOn(); it; ++it) {
      grid.tree().setValueOn(it.getCoord(), *it);
      valid->tree().setValueOn(it.getCoord());
    }
  }
  return valid;
}

MaskGrid::Ptr separatingCells(const LiquidCells& liquid, const SolidField& solid,
                              const std::vector<char>& detached) {
  MaskGrid::Ptr separating = MaskGrid::create();
  separating->setTransform(cellTransform(solid.voxelSize));
  const auto distance = solid.phi->getConstAccessor();
  const float deep = -kDeepInSolid * static_cast<float>(solid.voxelSize);
  for (int i = 0; i < liquid.numbering.size(); ++i) {
    if (!detached[i]) continue;
    const Coord cell = liquid.numbering.cell(i);
    separating->tree().setValueOn(cell);
    if (distance.getValue(cell) >= deep) continue;
    const LiquidSides& sides = liquid.sidesOf(i);
    for (int side = 0; side < kSides; ++side)
      if (sides.open[side] > 0.0f && liquid.numbering.at(neighborOf(cell, side)) >= 0)
        separating->tree().setValueOn(neighborOf(cell, side));
  }
  return separating;
}

}  // namespace fluidtex::sim
