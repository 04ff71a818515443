// Ties are broken as if the line were moved by (e, e^2) for a vanishing e: Edelsbrunner and Mücke,
// "Simulation of simplicity", 1990.
#include "sim/inside_test.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

constexpr double kLatticeSize = 536870912.0;  // 2^29: products of differences then fit 64 bits
constexpr int kMostBins = 2048;

using Place = std::array<std::int64_t, 2>;

std::int64_t area(const Place& a, const Place& b, const Place& p) {
  return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// On which side of the line from a to b the moved point lies: 1 left, -1 right, 0 where a is b.
int side(std::int64_t area, const Place& a, const Place& b) {
  if (area != 0) return area > 0 ? 1 : -1;
  if (a[1] != b[1]) return a[1] > b[1] ? 1 : -1;
  return a[0] == b[0] ? 0 : (a[0] < b[0] ? 1 : -1);
}

}  // namespace

InsideTest::InsideTest(const TriangleMesh& mesh) : m_mesh(mesh) {
  for (const openvdb::Vec3f& x : mesh.positions) m_bounds.expand(Vec3d(x));
  if (mesh.triangles.empty()) return;
  const Vec3d extents = m_bounds.extents();
  m_step = std::max({extents.x(), extents.y(), 1e-30}) / kLatticeSize;
  m_places.reserve(mesh.positions.size());
  for (const openvdb::Vec3f& x : mesh.positions) {
    m_places.push_back(onLattice(x.x(), x.y()));
    for (std::size_t a = 0; a < 2; ++a) m_span[a] = std::max(m_span[a], m_places.back()[a] + 1);
  }

  // About as many cells as triangles, and fewer where large triangles lie above many of them.
  m_bins = std::clamp(static_cast<int>(std::sqrt(double(mesh.triangles.size()))), 1, kMostBins);
  const auto forBins = [&](const openvdb::Vec3I& t, const auto& body) {
    std::array<int, 2> low{m_bins, m_bins}, high{0, 0};
    for (int c = 0; c < 3; ++c) {
      const auto bin = binOf(m_places[t[c]]);
      for (std::size_t a = 0; a < 2; ++a) {
        low[a] = std::min(low[a], bin[a]);
        high[a] = std::max(high[a], bin[a]);
      }
    }
    body(low, high);
  };
  for (;; m_bins = (m_bins + 1) / 2) {
    std::size_t entries = 0;
    for (const openvdb::Vec3I& t : mesh.triangles)
      forBins(t, [&](const auto& low, const auto& high) {
        entries += std::size_t(high[0] - low[0] + 1) * std::size_t(high[1] - low[1] + 1);
      });
    if (m_bins == 1 || entries <= 16 * mesh.triangles.size() + 4096) break;
  }
  const auto bins = static_cast<std::size_t>(m_bins);
  std::vector<std::size_t> next(bins * bins + 1, 0);
  const auto forCells = [&](const openvdb::Vec3I& t, const auto& body) {
    forBins(t, [&](const auto& low, const auto& high) {
      for (int i = low[0]; i <= high[0]; ++i)
        for (int j = low[1]; j <= high[1]; ++j) body(std::size_t(i) * bins + std::size_t(j));
    });
  };
  for (const openvdb::Vec3I& t : mesh.triangles) forCells(t, [&](std::size_t cell) { ++next[cell + 1]; });
  for (std::size_t cell = 0; cell < bins * bins; ++cell) next[cell + 1] += next[cell];
  m_first = next;
  m_triangles.resize(next.back());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    forCells(mesh.triangles[n],
             [&](std::size_t cell) { m_triangles[next[cell]++] = static_cast<std::uint32_t>(n); });
}

InsideTest::Lattice InsideTest::onLattice(double x, double y) const {
  return {std::llround((x - m_bounds.min().x()) / m_step), std::llround((y - m_bounds.min().y()) / m_step)};
}

std::array<int, 2> InsideTest::binOf(const Lattice& place) const {
  std::array<int, 2> bin{};
  for (std::size_t a = 0; a < 2; ++a)
    bin[a] = static_cast<int>(std::clamp<std::int64_t>(place[a] * m_bins / m_span[a], 0, m_bins - 1));
  return bin;
}

void InsideTest::crossings(double x, double y, Crossings& found) const {
  found.clear();
  if (m_triangles.empty() || x < m_bounds.min().x() || x > m_bounds.max().x() || y < m_bounds.min().y() ||
      y > m_bounds.max().y())
    return;
  const Lattice p = onLattice(x, y);
  const auto bin = binOf(p);
  const std::size_t cell = std::size_t(bin[0]) * std::size_t(m_bins) + std::size_t(bin[1]);
  for (std::size_t n = m_first[cell]; n < m_first[cell + 1]; ++n) {
    const openvdb::Vec3I& t = m_mesh.triangles[m_triangles[n]];
    const Lattice &a = m_places[t[0]], &b = m_places[t[1]], &c = m_places[t[2]];
    const std::int64_t ofC = area(a, b, p), ofA = area(b, c, p), ofB = area(c, a, p);
    const int step = side(ofC, a, b);
    if (step == 0 || side(ofA, b, c) != step || side(ofB, c, a) != step) continue;
    const double sum = double(ofA) + double(ofB) + double(ofC);
    const auto z = [&](int corner) { return double(m_mesh.positions[t[corner]].z()); };
    found.push_back(
        {sum == 0.0 ? z(0) : (double(ofA) * z(0) + double(ofB) * z(1) + double(ofC) * z(2)) / sum, step});
  }
}

int InsideTest::winding(const Crossings& crossings, double z) {
  int winding = 0;
  for (const Crossing& crossing : crossings)
    if (crossing.z > z) winding += crossing.step;
  return winding;
}

int InsideTest::winding(const Vec3d& x) const {
  Crossings found;
  crossings(x.x(), x.y(), found);
  return winding(found, x.z());
}

}  // namespace fluidtex::sim
