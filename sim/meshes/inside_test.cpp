// Ties are broken as if the line were moved by (e, e^2) for a vanishing e: Edelsbrunner and Mücke,
// "Simulation of simplicity", 1990.
#include "sim/meshes/inside_test.h"

#include "sim/meshes/triangle_mesh.h"
#include "sim/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fluidtex::sim {
namespace {

constexpr double kLatticeSize = 536870912.0;  // 2^29: products of differences then fit 64 bits

// Across the line.
using LatticePlace = std::array<std::int64_t, 2>;

std::int64_t area(const LatticePlace& a, const LatticePlace& b, const LatticePlace& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// On which side of the line from a to b the moved point lies: 1 left, -1 right, 0 where a is b.
int side(std::int64_t area, const LatticePlace& a, const LatticePlace& b) {
  if (area != 0) return area > 0 ? 1 : -1;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return a[0] == b[0] ? 0 : (a[0] < b[0] ? 1 : -1);
}

}  // namespace

InsideTest::InsideTest(TriangleMesh mesh)
    : InsideTest(std::make_shared<const TriangleTree>(std::move(mesh))) {}

InsideTest::InsideTest(std::shared_ptr<const TriangleTree> surface) : m_surface(std::move(surface)) {
  const TriangleMesh& mesh = m_surface->mesh();
  for (const openvdb::Vec3f& x : mesh.positions) m_bounds.expand(Vec3d(x));
  if (mesh.triangles.empty()) return;
  const Vec3d extents = m_bounds.extents();
  m_step = std::max({extents.x(), extents.y(), extents.z(), 1e-30}) / kLatticeSize;
  m_places.reserve(mesh.positions.size());
  for (const openvdb::Vec3f& x : mesh.positions) m_places.push_back(onLattice(Vec3d(x)));
}

InsideTest::Lattice InsideTest::onLattice(const Vec3d& x) const {
  Lattice place{};
  for (std::size_t a = 0; a < 3; ++a)
    place[a] = static_cast<std::int32_t>(std::llround((x[int(a)] - m_bounds.min()[int(a)]) / m_step));
  return place;
}

template <class Body>
void InsideTest::forCrossings(const Vec3d& x, int axis, const Body& body) const {
  const int s = (axis + 1) % 3, t = (axis + 2) % 3;
  const Vec3d &low = m_bounds.min(), &high = m_bounds.max();
  if (m_places.empty() || x[s] < low[s] || x[s] > high[s] || x[t] < low[t] || x[t] > high[t]) return;
  Vec3d within = x;
  within[axis] = low[axis];
  const auto across = [&](const Lattice& place) {
    return LatticePlace{place[std::size_t(s)], place[std::size_t(t)]};
  };
  const LatticePlace p = across(onLattice(within));
  const TriangleMesh& mesh = m_surface->mesh();
  // What a box holds lies within a step of where it is on the lattice.
  m_surface->forBeyond(x, axis, 2.0 * m_step, [&](int triangle) {
    const openvdb::Vec3I& corners = mesh.triangles[triangle];
    const LatticePlace a = across(m_places[corners[0]]), b = across(m_places[corners[1]]),
                       c = across(m_places[corners[2]]);
    const std::int64_t ofC = area(a, b, p), ofA = area(b, c, p), ofB = area(c, a, p);
    const int step = side(ofC, a, b);
    if (step == 0 || side(ofA, b, c) != step || side(ofB, c, a) != step) return;
    const double sum = double(ofA) + double(ofB) + double(ofC);
    const auto at = [&](int n) { return double(mesh.positions[corners[n]][axis]); };
    body(sum == 0.0 ? at(0) : (double(ofA) * at(0) + double(ofB) * at(1) + double(ofC) * at(2)) / sum, step);
  });
}

void InsideTest::crossings(double x, double y, Crossings& found) const {
  found.clear();
  forCrossings(Vec3d(x, y, -kForever), 2, [&](double z, int step) { found.push_back({z, step}); });
}

int InsideTest::winding(const Crossings& crossings, double z) {
  int winding = 0;
  for (const Crossing& crossing : crossings)
    if (crossing.z > z) winding += crossing.step;
  return winding;
}

int InsideTest::winding(const Vec3d& x, int axis) const {
  int winding = 0;
  forCrossings(x, axis, [&](double at, int step) {
    if (at > x[axis]) winding += step;
  });
  return winding;
}

}  // namespace fluidtex::sim
