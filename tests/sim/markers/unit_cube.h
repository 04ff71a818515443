// Surfaces and markers in a cube of 1 m with 32 cells a side.
#pragma once

#include "sim/markers/markers.h"
#include "sim/surface/level_set.h"

#include <functional>

namespace fluidtex::sim {

constexpr int kCells = 32;
constexpr double kVoxel = 1.0 / kCells;

inline FloatGrid::Ptr phiOf(const std::function<double(const Vec3d&)>& distance) {
  const auto phi = makePhi(kVoxel, 6 * kVoxel);
  unite(*phi, distance, firstCells(Coord(kCells)));
  trimBand(*phi, *makePhi(kVoxel, 3 * kVoxel));
  return phi;
}

inline FloatGrid::Ptr noSolid() {
  return makePhi(kVoxel, 3 * kVoxel);
}

inline Vec3d worldOf(const MarkerBlock& block, const Marker& m) {
  return kVoxel * (block.origin.asVec3d() + Vec3d(m.x, m.y, m.z) + Vec3d(0.5));
}

inline std::size_t countOf(const Markers& markers) {
  std::size_t count = 0;
  for (const MarkerBlock& block : markers) count += block.markers.size();
  return count;
}

}  // namespace fluidtex::sim
