#include "sim/volume/poured_volume.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/surface/cell_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fluidtex::sim {
namespace {

// Share of a cell: recomputed distances differ by less where no volume is lost.
constexpr float kRounding = 1e-3f;
// Error bound of a cell's share by the distance from its centre alone, for an oblique plane.
constexpr float kSlanted = 0.05f;

// The share of a cell inside a body: by the distance from its centre, as in liquidShares, but near edges by
// the distances of the cell's eight parts.
float shareOf(const std::function<double(const Vec3d&)>& body, float far, const Vec3d& middle, float h) {
  double fine = 0.0;
  for (int part = 0; part < 8; ++part) {
    const Vec3d towards(part >> 2, (part >> 1) & 1, part & 1);
    fine += std::clamp(0.5 - body(middle + 0.5 * h * (towards - Vec3d(0.5))) / (0.5 * h), 0.0, 1.0) / 8.0;
  }
  const double coarse = std::clamp(0.5 - double(far) / h, 0.0, 1.0);
  return static_cast<float>(std::abs(fine - coarse) > kSlanted ? fine : coarse);
}

// The share of a cell inside a body and outside solids, both known anywhere.
float openShareOf(const PouredLiquid& poured, const Vec3d& middle, float h) {
  constexpr int kParts = 4;  // along each axis
  const double step = double(h) / kParts;
  double share = 0.0;
  for (int i = 0; i < kParts; ++i) {
    for (int j = 0; j < kParts; ++j) {
      for (int k = 0; k < kParts; ++k) {
        const Vec3d x = middle + step * (Vec3d(i, j, k) + Vec3d(0.5) - Vec3d(0.5 * kParts));
        share += std::clamp(0.5 - std::max(poured.distance(x), -poured.solids(x)) / step, 0.0, 1.0);
      }
    }
  }
  return static_cast<float>(share / (kParts * kParts * kParts));
}

}  // namespace

FloatGrid::Ptr withPoured(const FloatGrid* deficit, const PouredLiquid& poured, const FloatGrid& settled,
                          const SolidField& solid, const RunningFlows& flows) {
  const float h = static_cast<float>(solid.voxelSize);
  FloatGrid::Ptr result = deficit != nullptr ? deficit->deepCopy() : FloatGrid::create(0.0f);
  result->setTransform(cellTransform(solid.voxelSize));
  result->setName("deficit");
  const auto leaves = leavesOf(poured.bodies.constTree());
  std::vector<LeafShares> more(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves[n]->origin();
    more[n].fill(0.0f);
    LeafShares seen, whole, after;
    liquidShares(poured.phi, solid, origin, seen);
    liquidShares(poured.phi, solid, origin, whole, Counts::unseen);
    liquidShares(settled, solid, origin, after);
    float scratch[kLeafSize];
    const float* room = leafValues(solid.phi->constTree(), origin, scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      const Coord cell = leaves[n]->offsetToGlobalCoord(i);
      const float far = leaves[n]->getValue(i);
      if (!solid.domain.isInside(cell) || std::abs(far) >= h) continue;
      const bool inOpen = poured.start && room[i] >= h;
      // Later, what settling loses is in the deficit already.
      const float shown = poured.start ? after[i] : seen[i];
      const bool isUnseen = shown == 0.0f && whole[i] > 0.0f && far < 0.5f * h;
      if (!inOpen && !isUnseen) continue;
      const Vec3d middle = settled.indexToWorld(cell);
      more[n][i] = inOpen ? shareOf(poured.distance, far, middle, h) - after[i]
                          : std::min(whole[i], openShareOf(poured, middle, h));
    }
    const auto none = [&](const FloatGrid& shape, float near) {
      float values[kLeafSize];
      const float* distance = leafValues(shape.constTree(), origin, values);
      for (int i = 0; i < kLeafSize; ++i)
        if (distance[i] < near) more[n][i] = 0.0f;
    };
    for (const auto& running : flows.sources) none(*running.source->phi, 0.0f);
    for (const FloatGrid* drain : flows.drains) none(*drain, h);
  });
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (std::all_of(more[n].begin(), more[n].end(), [](float v) { return std::abs(v) < kRounding; }))
      continue;
    FloatLeaf* to = result->tree().touchLeaf(leaves[n]->origin());
    to->setValuesOn();
    for (int i = 0; i < kLeafSize; ++i) to->setValueOnly(i, to->getValue(i) + more[n][i]);
  }
  return result;
}

}  // namespace fluidtex::sim
