// Octree subdivision: a block of cells whose centre is farther from every surface than its corners are is all
// liquid or all empty; any other is split into eight.
#include "pipeline/liquid_plan.h"

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fluidtex::pipeline {
namespace {

using openvdb::Coord;
using sim::Vec3d;

constexpr int kBlock = 64;  // cells per side of the largest blocks, a power of two

LiquidPlan sum(const LiquidPlan& a, const LiquidPlan& b) {
  return {a.cells + b.cells, a.atStart + b.atStart, a.surfaceCells + b.surfaceCells};
}

class Counter {
 public:
  explicit Counter(const sim::Options& options)
      : m_options(options), m_h(options.voxelSize()), m_domain(sim::domainCells(options)) {
    for (const sim::LiquidBody& body : options.liquid) {
      m_liquid.emplace_back(body.shape, m_h, sim::domainBox(options));
    }
    for (const sim::Solid& solid : options.solids)
      if (solid.from <= 0.0) m_solids.emplace_back(solid.shape, m_h, sim::domainBox(options));
  }

  // Lowest cells of the largest blocks that may hold liquid.
  std::vector<Coord> blocks() const {
    std::vector<Coord> blocks;
    for (const sim::ShapeDistance& liquid : m_liquid) {
      openvdb::CoordBBox box = sim::cellsIn(liquid.boundsIn(sim::domainBox(m_options)), m_h);
      box.intersect(m_domain);
      if (box.empty()) continue;
      const Coord first(box.min()[0] & -kBlock, box.min()[1] & -kBlock, box.min()[2] & -kBlock);
      for (int i = first[0]; i <= box.max()[0]; i += kBlock)
        for (int j = first[1]; j <= box.max()[1]; j += kBlock)
          for (int k = first[2]; k <= box.max()[2]; k += kBlock) blocks.emplace_back(i, j, k);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  LiquidPlan count(const Coord& low, int size) const {
    openvdb::CoordBBox inside = openvdb::CoordBBox::createCube(low, size);
    inside.intersect(m_domain);
    if (inside.empty()) return {};
    const auto cells = static_cast<std::int64_t>(inside.volume());
    const Vec3d center = m_h * (low.asVec3d() + Vec3d(0.5 * size));
    const double ever = distance(center, false), atStart = distance(center, true);
    if (size == 1) return {ever < 0.0, atStart < 0.0, ever < 0.0 && ever > -m_h};
    // One cell more than to the corners, as far as surface cells reach.
    const double reach = m_h * (0.5 * std::sqrt(3.0) * size + 1.0);
    if (std::abs(ever) > reach && std::abs(atStart) > reach)
      return {ever < 0.0 ? cells : 0, atStart < 0.0 ? cells : 0, 0};
    LiquidPlan plan;
    const int half = size / 2;
    for (int part = 0; part < 8; ++part)
      plan =
          sum(plan, count(low.offsetBy((part & 1) * half, (part >> 1 & 1) * half, (part >> 2) * half), half));
    return plan;
  }

 private:
  // Signed distance, negative inside, to the surface of all liquid or of that at the start; a lower bound in
  // magnitude.
  double distance(const Vec3d& x, bool atStart) const {
    double d = sim::kForever;
    for (std::size_t b = 0; b < m_liquid.size(); ++b)
      if (!atStart || m_options.liquid[b].from <= 0.0) d = std::min(d, m_liquid[b](x));
    for (const sim::ShapeDistance& solid : m_solids) d = std::max(d, -solid(x));
    for (int side = 0; side < 6; ++side) {
      if (m_options.sides[side] == sim::Side::unbounded) continue;
      const int axis = side / 2;
      d = std::max(d, side % 2 == 0 ? -x[axis] : x[axis] - m_options.size[axis]);
    }
    return d;
  }

  const sim::Options& m_options;
  double m_h;
  openvdb::CoordBBox m_domain;
  std::vector<sim::ShapeDistance> m_liquid, m_solids;
};

}  // namespace

LiquidPlan planLiquid(const sim::Options& options) {
  const Counter counter(options);
  const std::vector<Coord> blocks = counter.blocks();
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, blocks.size()), LiquidPlan{},
      [&](const tbb::blocked_range<std::size_t>& range, LiquidPlan plan) {
        for (std::size_t b = range.begin(); b != range.end(); ++b)
          plan = sum(plan, counter.count(blocks[b], kBlock));
        return plan;
      },
      sum);
}

}  // namespace fluidtex::pipeline
