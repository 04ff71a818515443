#include "caches/liquid/particle_cells.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Cells along an axis: the last ones hold all that lies farther.
constexpr int kBits = 21;
constexpr double kLastCell = double(1 << kBits) - 2.0;

std::uint64_t keyOf(int i, int j, int k) {
  return (std::uint64_t(i) << (2 * kBits)) + (std::uint64_t(j) << kBits) + std::uint64_t(k);
}

}  // namespace

ParticleCells::ParticleCells(const std::vector<Vec3f>& points, double reach) : m_reach(reach) {
  Vec3d low(std::numeric_limits<double>::max());
  for (const Vec3f& x : points) low = openvdb::math::minComponent(low, Vec3d(x));
  m_origin = low;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    const Coord cell = cellOf(Vec3d(points[n]));
    sorted[n] = {keyOf(cell[0], cell[1], cell[2]), std::uint32_t(n)};
  });
  tbb::parallel_sort(sorted);
  m_points.resize(points.size());
  m_order.resize(points.size());
  m_keys.resize(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) {
    m_keys[n] = sorted[n].first;
    m_order[n] = sorted[n].second;
    m_points[n] = points[sorted[n].second];
  });
}

Coord ParticleCells::cellOf(const Vec3d& x) const {
  Coord cell;
  for (int axis = 0; axis < 3; ++axis)
    cell[axis] = int(std::clamp(std::floor((x[axis] - m_origin[axis]) / m_reach), -1.0, kLastCell));
  return cell;
}

ParticleCells::Window::Window(const ParticleCells& cells, const Vec3d& low, const Vec3d& high)
    : m_cells(cells), m_low(cells.cellOf(low).offsetBy(-1)) {
  m_low.maxComponent(Coord(0));
  const Coord last = cells.cellOf(high).offsetBy(1);
  for (int axis = 0; axis < 3; ++axis) m_size[axis] = std::size_t(std::max(last[axis] - m_low[axis] + 1, 0));
  m_begin.resize(m_size[0] * m_size[1] * (m_size[2] + 1));
  const auto first = cells.m_keys.begin();
  auto at = m_begin.begin();
  for (int i = 0; i < int(m_size[0]); ++i)
    for (int j = 0; j < int(m_size[1]); ++j) {
      auto key = std::lower_bound(first, cells.m_keys.end(), keyOf(m_low[0] + i, m_low[1] + j, m_low[2]));
      for (int k = 0; k <= int(m_size[2]); ++k) {
        const std::uint64_t least = keyOf(m_low[0] + i, m_low[1] + j, m_low[2] + k);
        while (key != cells.m_keys.end() && *key < least) {
          ++key;
          m_empty = false;
        }
        *at++ = std::uint32_t(key - first);
      }
    }
}

}  // namespace fluidtex::caches
