// Closest points by a tree of boxes: triangles are halved by the middle one along the box's longest axis.
#include "sim/surface_velocity.h"

#include <openvdb/math/Proximity.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3f;

constexpr int kLeafTriangles = 4;
// Halving makes the tree as deep as the logarithm of the number of triangles; one entry a level waits.
constexpr int kDeepest = 64;

}  // namespace

SurfaceVelocity::SurfaceVelocity(TriangleMesh mesh, std::vector<Vec3f> velocity)
    : m_mesh(std::move(mesh)), m_velocity(std::move(velocity)), m_order(m_mesh.triangles.size()) {
  std::iota(m_order.begin(), m_order.end(), 0);
  m_nodes.emplace_back();
  build(0, 0, static_cast<int>(m_order.size()));
}

void SurfaceVelocity::build(int node, int first, int count) {
  const auto corner = [&](int triangle, int k) { return m_mesh.positions[m_mesh.triangles[triangle][k]]; };
  Vec3f low(std::numeric_limits<float>::max()), high(-low);
  for (int i = first; i < first + count; ++i) {
    for (int k = 0; k < 3; ++k) {
      low = openvdb::math::minComponent(low, corner(m_order[i], k));
      high = openvdb::math::maxComponent(high, corner(m_order[i], k));
    }
  }
  m_nodes[node] = {low, high, first, count};
  if (count <= kLeafTriangles) return;
  const Vec3f extent = high - low;
  const int axis = static_cast<int>(openvdb::math::MaxIndex(extent));
  const auto middle = [&](int t) { return corner(t, 0)[axis] + corner(t, 1)[axis] + corner(t, 2)[axis]; };
  const int half = count / 2;
  std::nth_element(m_order.begin() + first, m_order.begin() + first + half, m_order.begin() + first + count,
                   [&](int a, int b) { return middle(a) != middle(b) ? middle(a) < middle(b) : a < b; });
  const int children = static_cast<int>(m_nodes.size());
  m_nodes[node].first = children;
  m_nodes[node].count = 0;
  m_nodes.resize(m_nodes.size() + 2);
  build(children, first, half);
  build(children + 1, first + half, count - half);
}

double SurfaceVelocity::squareTo(const Node& node, const Vec3d& x) const {
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = std::max({node.low[axis] - x[axis], x[axis] - node.high[axis], 0.0});
    square += d * d;
  }
  return square;
}

// The nearest triangle, of several the first, that is nearer than `closest` or as near.
void SurfaceVelocity::search(const Vec3d& x, Closest& closest) const {
  std::array<int, kDeepest> waiting;
  int size = 0;
  waiting[size++] = 0;
  while (size > 0) {
    const Node& node = m_nodes[waiting[--size]];
    if (squareTo(node, x) > closest.square) continue;
    if (node.count == 0) {
      const bool swapped = squareTo(m_nodes[node.first], x) > squareTo(m_nodes[node.first + 1], x);
      waiting[size++] = node.first + (swapped ? 0 : 1);
      waiting[size++] = node.first + (swapped ? 1 : 0);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const int t = m_order[i];
      const auto corner = [&](int k) { return Vec3d(m_mesh.positions[m_mesh.triangles[t][k]]); };
      Vec3d weight;
      const Vec3d at =
          openvdb::math::closestPointOnTriangleToPoint(corner(0), corner(1), corner(2), x, weight);
      const double square = (at - x).lengthSqr();
      // One without area may have no closest point; its neighbours share its edges.
      if (!std::isfinite(square + weight.sum())) continue;
      if (square < closest.square || (square == closest.square && t < closest.triangle))
        closest = {square, t, weight};
    }
  }
}

Vec3d SurfaceVelocity::at(const Vec3d& x, double reach) const {
  constexpr int kNone = std::numeric_limits<int>::max();
  Closest closest{reach * reach, kNone, Vec3d(0.0)};
  search(x, closest);
  if (closest.triangle == kNone) {
    closest.square = kForever;
    search(x, closest);
  }
  if (closest.triangle == kNone) return Vec3d(0.0);
  Vec3d velocity(0.0);
  const openvdb::Vec3I& t = m_mesh.triangles[closest.triangle];
  for (int k = 0; k < 3; ++k) velocity += closest.weight[k] * Vec3d(m_velocity[t[k]]);
  return velocity;
}

}  // namespace fluidtex::sim
