// The closest point of one triangle follows Ericson: Real-Time Collision Detection (2005), sec. 5.1.5.
#include "transport/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fluidtex::transport {
namespace {

using openvdb::Coord;

// Relative to a triangle's size: tolerance of culling, so that rounding never culls a tie.
constexpr float kSlack = 2e-3f;

// Barycentric weights of the point of triangle (0, ab, ac) closest to p.
Vec3f closestWeights(const Vec3f& p, const Vec3f& ab, const Vec3f& ac) {
  const float d1 = ab.dot(p), d2 = ac.dot(p);
  if (d1 <= 0.0f && d2 <= 0.0f) return {1, 0, 0};
  const Vec3f bp = p - ab;
  const float d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0f && d4 <= d3) return {0, 1, 0};
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
    const float t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const Vec3f cp = p - ac;
  const float d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0f && d5 <= d6) return {0, 0, 1};
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
    const float t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 - d3 >= 0.0f && d5 - d6 >= 0.0f) {
    const float t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const float scale = 1.0f / (va + vb + vc), v = vb * scale, w = vc * scale;
  return {1 - v - w, v, w};
}

}  // namespace

// A query and the best answer so far.
struct ClosestPoint::Search {
  Vec3d x;
  Vec3f normal;
  float penalty2;
  float score = std::numeric_limits<float>::infinity(), reach = score;  // reach^2 = score
  std::uint32_t triangle = 0;
  Vec3f weight{1.0f, 0.0f, 0.0f};
};

inline openvdb::Coord ClosestPoint::cellOf(const Vec3d& x) const {
  // Far outside all cells any cell index will do. In this order min and max are one instruction each.
  const auto part = [&](double value) {
    return int(std::max(-1e9, std::min(1e9, std::floor(value * m_cellsPerMetre))));
  };
  return {part(x.x()), part(x.y()), part(x.z())};
}

ClosestPoint::ClosestPoint(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles)
    : m_positions(positions), m_triangles(triangles), m_bounds(triangles.size()) {
  if (triangles.empty()) throw std::invalid_argument("closest points need at least one triangle");
  for (const Vec3I& t : triangles) {
    if (std::max({t[0], t[1], t[2]}) >= positions.size())
      throw std::invalid_argument("closest points: a triangle has a vertex that does not exist");
  }
  double sum = 0.0, longest = 0.0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Vec3f a = positions[triangles[t][0]], ab = positions[triangles[t][1]] - a,
                ac = positions[triangles[t][2]] - a;
    const double edge = std::sqrt(std::max({ab.lengthSqr(), ac.lengthSqr(), (ac - ab).lengthSqr()}));
    sum += edge;
    longest = std::max(longest, edge);
    Vec3f n = ab.cross(ac);
    if (!n.normalize(0.0f)) continue;
    const Vec3f middle = (ab + ac) / 3.0f;
    const float radius2 =
        std::max({middle.lengthSqr(), (ab - middle).lengthSqr(), (ac - middle).lengthSqr()});
    m_bounds[t] = {a + middle, (1.0f + kSlack) * std::sqrt(radius2), n};
  }
  // The second bound keeps a huge triangle among small ones from filling millions of cells.
  m_cellSize = std::max({1.3 * sum / double(triangles.size()), longest / 32.0, 1e-30});
  m_cellsPerMetre = 1.0 / m_cellSize;

  Block* block = nullptr;
  const auto at = [&](const Coord& cell) -> std::uint32_t& {
    const Coord origin(cell.x() & ~(kSide - 1), cell.y() & ~(kSide - 1), cell.z() & ~(kSide - 1));
    if (!block || block->origin != origin) block = &makeBlock(origin);
    const Coord local = cell - origin;
    return block->first[(local.x() * kSide + local.y()) * kSide + local.z()];
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) forEachCell(t, [&](const Coord& cell) { ++at(cell); });
  std::uint32_t count = 0;
  for (Block& each : m_blocks) {
    for (std::uint32_t& first : each.first) {
      count += first;
      first = count;  // the end of the cell; filling from the back turns it into the beginning
    }
  }
  m_entries.resize(count);
  for (auto t = std::uint32_t(triangles.size()); t-- > 0;) {
    forEachCell(t, [&](const Coord& cell) { m_entries[--at(cell)] = t; });
  }
}

const ClosestPoint::Block* ClosestPoint::findBlock(const Coord& origin) const {
  const std::uint32_t number = m_places.find(origin);
  return number == BlockTable::kNone ? nullptr : &m_blocks[number];
}

ClosestPoint::Block& ClosestPoint::makeBlock(const Coord& origin) {
  const std::uint32_t number = m_places.enter(origin);
  if (number == m_blocks.size()) m_blocks.emplace_back().origin = origin;
  return m_blocks[number];
}

template <typename Visit>
void ClosestPoint::forEachCell(std::uint32_t triangle, const Visit& visit) const {
  // Degenerate: its points are on its neighbours' edges.
  if (m_bounds[triangle].radius < 0.0f) return;
  const Vec3I& t = m_triangles[triangle];
  const Vec3f &a = m_positions[t[0]], &b = m_positions[t[1]], &c = m_positions[t[2]];
  const Coord lower = cellOf(Vec3d(openvdb::math::minComponent(openvdb::math::minComponent(a, b), c)));
  const Coord upper = cellOf(Vec3d(openvdb::math::maxComponent(openvdb::math::maxComponent(a, b), c)));
  for (int i = lower.x(); i <= upper.x(); ++i) {
    for (int j = lower.y(); j <= upper.y(); ++j) {
      for (int k = lower.z(); k <= upper.z(); ++k) visit(Coord(i, j, k));
    }
  }
}

// To the cube of `cells` cells per side.
double ClosestPoint::squaredDistance(const Vec3d& x, const Coord& lower, int cells) const {
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double begin = lower[axis] * m_cellSize, end = (double(lower[axis]) + cells) * m_cellSize;
    const double outside = std::max({begin - x[axis], x[axis] - end, 0.0});
    sum += outside * outside;
  }
  return sum;
}

void ClosestPoint::visitTriangle(std::uint32_t triangle, Search& search) const {
  const Bounds& bounds = m_bounds[triangle];
  const Vec3f fromCenter(search.x - Vec3d(bounds.center));
  const float reach = bounds.radius + search.reach;
  if (fromCenter.lengthSqr() > reach * reach) return;
  const float disagreement = std::clamp((0.5f - bounds.normal.dot(search.normal)) / 1.5f, 0.0f, 1.0f);
  const float penalty2 = search.penalty2 * disagreement * disagreement;
  const float height = std::max(0.0f, std::abs(bounds.normal.dot(fromCenter)) - kSlack * bounds.radius);
  if (height * height + penalty2 > search.score) return;
  const Vec3I& t = m_triangles[triangle];
  const Vec3f& a = m_positions[t[0]];
  const Vec3f p(search.x - Vec3d(a));
  const Vec3f ab = m_positions[t[1]] - a, ac = m_positions[t[2]] - a;
  const Vec3f weight = closestWeights(p, ab, ac);
  const float score = (p - ab * weight[1] - ac * weight[2]).lengthSqr() + penalty2;
  if (!(score < search.score || (score == search.score && triangle < search.triangle))) return;
  search.score = score;
  search.reach = std::sqrt(score);
  search.triangle = triangle;
  search.weight = weight;
}

void ClosestPoint::visitCells(const Coord& lower, const Coord& upper, Search& search) const {
  const Block* block = nullptr;
  Coord known = Coord::max();
  for (int i = lower.x(); i <= upper.x(); ++i) {
    for (int j = lower.y(); j <= upper.y(); ++j) {
      for (int k = lower.z(); k <= upper.z(); ++k) {
        const Coord cell(i, j, k), origin(i & ~(kSide - 1), j & ~(kSide - 1), k & ~(kSide - 1));
        if (origin != known) {
          known = origin;
          block = findBlock(origin);
        }
        if (!block) continue;
        const Coord local = cell - origin;
        const int index = (local.x() * kSide + local.y()) * kSide + local.z();
        const std::uint32_t begin = block->first[index], end = block->first[index + 1];
        if (begin == end || squaredDistance(search.x, cell, 1) > search.score) continue;
        for (std::uint32_t entry = begin; entry < end; ++entry) visitTriangle(m_entries[entry], search);
      }
    }
  }
}

// Visits every triangle that can matter, block by block, the nearest block first.
void ClosestPoint::visitAll(Search& search) const {
  const auto visit = [&](const Block& block) {
    visitCells(block.origin, block.origin.offsetBy(kSide - 1), search);
  };
  const Block* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Block& block : m_blocks) {
    const double distance2 = squaredDistance(search.x, block.origin, kSide);
    if (distance2 < least) {
      least = distance2;
      nearest = &block;
    }
  }
  if (nearest) visit(*nearest);
  for (const Block& block : m_blocks) {
    if (&block != nearest && squaredDistance(search.x, block.origin, kSide) <= search.score) visit(block);
  }
}

SurfacePoint ClosestPoint::nearest(const Vec3d& x, const Vec3f& normal, double penalty) const {
  constexpr int kNearCells = 4;  // to each side; further out whole blocks are quicker
  Search search{x, normal, float(penalty * penalty)};
  const Coord cell = cellOf(x);
  visitCells(cell, cell, search);
  if (!std::isfinite(search.score)) visitCells(cell.offsetBy(-1), cell.offsetBy(1), search);
  const double radius = std::sqrt(double(search.score));
  if (radius < kNearCells * m_cellSize) {
    const Coord lower = cellOf(x - Vec3d(radius)), upper = cellOf(x + Vec3d(radius));
    if (lower != cell || upper != cell) visitCells(lower, upper, search);
  } else {
    visitAll(search);
  }

  SurfacePoint result;
  result.triangle = search.triangle;
  result.weight = search.weight;
  const Vec3I& t = m_triangles[search.triangle];
  for (int i = 0; i < 3; ++i) result.position += Vec3d(m_positions[t[i]]) * double(search.weight[i]);
  result.distance = (x - result.position).length();
  return result;
}

}  // namespace fluidtex::transport
