// What the tests of the solver begin with, and whether two of its grids are the same.
#pragma once

#include "sim/step/solver.h"
#include "tools/validation/face_velocities.h"

#include <array>
#include <cstring>
#include <utility>
#include <vector>

namespace fluidtex::sim {

inline Options tank(int resolution, std::vector<LiquidBody> liquid) {
  Options options;
  options.resolution = resolution;
  options.liquid = std::move(liquid);
  return options;
}

inline LiquidBody box(const Vec3d& min, const Vec3d& max) {
  return {Shape{Box{min, max}}, Vec3d(0.0), 0.0};
}

// Same topology, same values, bit for bit.
template <typename Grid>
bool same(const Grid& a, const Grid& b) {
  if (!a.tree().hasSameTopology(b.tree()) || a.transform() != b.transform()) return false;
  const auto leavesA = a.tree().leafCount(), leavesB = b.tree().leafCount();
  if (leavesA != leavesB) return false;
  auto other = b.tree().cbeginLeaf();
  for (auto leaf = a.tree().cbeginLeaf(); leaf; ++leaf, ++other) {
    if (leaf->origin() != other->origin()) return false;
    if (std::memcmp(leaf->buffer().data(), other->buffer().data(), sizeof(float) * 512) != 0) return false;
  }
  auto tileB = b.tree().cbeginValueAll();
  for (auto tile = a.tree().cbeginValueAll(); tile && tileB; ++tile, ++tileB) {
    if (*tile != *tileB) return false;
  }
  return true;
}

using validation::fastestOf;

}  // namespace fluidtex::sim
