// Triangles are halved twice for each node, by the middle one along the box's longest axis.
#include "sim/meshes/triangle_tree.h"

#include "numerics/lanes.h"
#include "sim/options.h"

#include <immintrin.h>
#include <openvdb/math/Proximity.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3f;
using openvdb::math::maxComponent;
using openvdb::math::minComponent;

constexpr int kLeafTriangles = 4;
// Halves of more triangles than this are divided at the same time.
constexpr int kMany = 4096;

// How many nodes a tree of so many triangles has, and one of one more: quarters differ by one at most. None
// for what is a leaf.
std::pair<int, int> nodesOf(int triangles) {
  if (triangles < kLeafTriangles) return {0, 0};
  if (triangles == kLeafTriangles) return {0, 1};
  const auto [quarter, more] = nodesOf(triangles / 4);
  const int rest = triangles % 4;
  return {1 + (4 - rest) * quarter + rest * more,
          1 + (rest == 3 ? 4 * more : (3 - rest) * quarter + (rest + 1) * more)};
}

}  // namespace

// A place, and the squares of distances to boxes around it: never too large, so that none is passed over, and
// with four numbers at once.
class TriangleTree::Sought {
 public:
  explicit Sought(const Vec3d& x)
      : m_rounding(float4(2.5e-7f * float(std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])})))),
        m_place(float4(float(x[0]), float(x[1]), float(x[2]))) {
    for (int a = 0; a < 3; ++a) m_along[a] = float4(float(x[a]));
  }
  // To each of a node's boxes.
  std::array<float, kWays> squaresTo(const Node& node) const {
    Float4 sum{};
    for (int a = 0; a < 3; ++a) {
      const Float4 away = beyond(load4(node.low[a]), load4(node.high[a]), m_along[a]);
      sum += away * away;
    }
    std::array<float, kWays> squares;
    store4(squares.data(), kLess * sum);
    return squares;
  }
  // To the box around a triangle.
  float squareTo(const Vec3f& a, const Vec3f& b, const Vec3f& c) const {
    const Float4 p = float4(a[0], a[1], a[2]), q = float4(b[0], b[1], b[2]), r = float4(c[0], c[1], c[2]);
    const Float4 away = beyond(_mm_min_ps(p, _mm_min_ps(q, r)), _mm_max_ps(p, _mm_max_ps(q, r)), m_place);
    return kLess * _mm_cvtss_f32(_mm_dp_ps(away, away, 0xf1));
  }

 private:
  // More than what is lost in squares.
  static constexpr float kLess = 1.0f - 1e-6f;
  Float4 beyond(Float4 low, Float4 high, Float4 place) const {
    return _mm_max_ps(_mm_max_ps(low - place, place - high) - m_rounding, Float4{});
  }
  Float4 m_rounding, m_place;
  Float4 m_along[3];
};

TriangleTree::TriangleTree(TriangleMesh mesh) : m_mesh(std::move(mesh)) {
  m_triangles.resize(m_mesh.triangles.size());
  std::vector<Vec3f> middles(m_triangles.size());  // three times
  tbb::parallel_for(std::size_t{0}, middles.size(), [&](std::size_t t) {
    const openvdb::Vec3I& corners = m_mesh.triangles[t];
    m_triangles[t] = {corners, static_cast<int>(t)};
    middles[t] = m_mesh.positions[corners[0]] + m_mesh.positions[corners[1]] + m_mesh.positions[corners[2]];
  });
  const int count = static_cast<int>(m_triangles.size());
  m_nodes.resize(static_cast<std::size_t>(std::max(1, nodesOf(count).first)));
  if (count > kLeafTriangles) {
    build(middles, 0, 1, 0, count);
    return;
  }
  for (int way = 0; way < kWays; ++way) m_nodes[0].count[way] = kNothing;
  if (count > 0) setBox(m_nodes[0], 0, 0, count);
}

int TriangleTree::halved(const std::vector<Vec3f>& middles, int first, int count) {
  Vec3f low(std::numeric_limits<float>::max()), high(-low);
  for (int i = first; i < first + count; ++i) {
    low = minComponent(low, middles[m_triangles[i].number]);
    high = maxComponent(high, middles[m_triangles[i].number]);
  }
  const int axis = static_cast<int>(openvdb::math::MaxIndex(high - low));
  const int half = count / 2;
  const auto begin = m_triangles.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](const Triangle& a, const Triangle& b) {
    const float left = middles[a.number][axis], right = middles[b.number][axis];
    return left != right ? left < right : a.number < b.number;
  });
  return half;
}

void TriangleTree::setBox(Node& node, int way, int first, int count) const {
  Vec3f low(std::numeric_limits<float>::max()), high(-low);
  for (int i = first; i < first + count; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vec3f& corner = m_mesh.positions[m_triangles[i].corners[k]];
      low = minComponent(low, corner);
      high = maxComponent(high, corner);
    }
  }
  for (int a = 0; a < 3; ++a) {
    node.low[a][way] = low[a];
    node.high[a][way] = high[a];
  }
  node.first[way] = first;
  node.count[way] = count;
}

// below: where the nodes below this one begin. Those of each quarter lie together, so that where a node lies
// does not depend on which quarter is done first.
void TriangleTree::build(const std::vector<Vec3f>& middles, int node, int below, int first, int count) {
  const int half = halved(middles, first, count);
  const int lower = halved(middles, first, half), upper = halved(middles, first + half, count - half);
  const std::array<int, kWays> counts{lower, half - lower, upper, count - half - upper};
  std::array<int, kWays> firsts, nodes;
  for (int way = 0; way < kWays; ++way) {
    firsts[way] = way == 0 ? first : firsts[way - 1] + counts[way - 1];
    nodes[way] = way == 0 ? below : nodes[way - 1] + nodesOf(counts[way - 1]).first;
  }
  const auto divide = [&](int way) {
    setBox(m_nodes[node], way, firsts[way], counts[way]);
    if (counts[way] <= kLeafTriangles) return;
    m_nodes[node].first[way] = nodes[way];
    m_nodes[node].count[way] = 0;
    build(middles, nodes[way], nodes[way] + 1, firsts[way], counts[way]);
  };
  if (count > kMany) {
    tbb::parallel_for(0, kWays, divide);
  } else {
    for (int way = 0; way < kWays; ++way) divide(way);
  }
}

// The nearest triangle that is nearer than `closest`, or as near and before it.
void TriangleTree::search(const Vec3d& x, Closest& closest) const {
  std::array<std::pair<int, float>, kMostWaiting> waiting;  // nodes, and the squares of their distances
  int size = 0;
  const Sought sought(x);
  waiting[size++] = {0, 0.0f};
  while (size > 0) {
    const auto [number, square] = waiting[--size];
    if (double(square) > closest.square) continue;
    const Node& node = m_nodes[number];
    const std::array<float, kWays> squares = sought.squaresTo(node);
    const int begin = size;
    for (int way = 0; way < kWays; ++way) {
      if (node.count[way] == kNothing || double(squares[way]) > closest.square) continue;
      if (node.count[way] == 0) {
        // The nearest one is the next.
        int place = size++;
        for (; place > begin && waiting[place - 1].second < squares[way]; --place)
          waiting[place] = waiting[place - 1];
        waiting[place] = {node.first[way], squares[way]};
        continue;
      }
      for (int i = node.first[way]; i < node.first[way] + node.count[way]; ++i) {
        const int t = m_triangles[i].number;
        const Vec3f &a = m_mesh.positions[m_triangles[i].corners[0]],
                    &b = m_mesh.positions[m_triangles[i].corners[1]],
                    &c = m_mesh.positions[m_triangles[i].corners[2]];
        // That takes less time than the closest point of the triangle itself.
        if (double(sought.squareTo(a, b, c)) > closest.square) continue;
        Vec3d weight;
        const Vec3d at =
            openvdb::math::closestPointOnTriangleToPoint(Vec3d(a), Vec3d(b), Vec3d(c), x, weight);
        const double toTriangle = (at - x).lengthSqr();
        // One without area may have no closest point; its neighbours share its edges.
        if (!std::isfinite(toTriangle + weight.sum())) continue;
        if (toTriangle < closest.square || (toTriangle == closest.square && t < closest.triangle))
          closest = {toTriangle, t, weight};
      }
    }
  }
}

TriangleTree::Closest TriangleTree::closest(const Vec3d& x, double guess) const {
  constexpr int kNone = std::numeric_limits<int>::max();
  Closest closest{guess * guess, kNone, Vec3d(0.0)};
  search(x, closest);
  if (closest.triangle == kNone) {
    closest.square = kForever;
    search(x, closest);
  }
  if (closest.triangle == kNone) closest.triangle = -1;
  return closest;
}

}  // namespace fluidtex::sim
