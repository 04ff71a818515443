#include "sim/shapes/moving_mesh.h"

#include "sim/meshes/closed_surface.h"
#include "sim/meshes/read_mesh.h"
#include "sim/meshes/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3f;
using openvdb::Vec3I;
using Corners = std::vector<std::size_t>;

[[noreturn]] void failDifferent(const std::filesystem::path& file, const std::filesystem::path& first,
                                const std::string& how) {
  throw MeshError(file.string() + ": " + how + " " + first.string() +
                  "; all files of a sequence must have the same vertices and faces in the same order");
}

std::string sizeOf(const MeshSoup& soup) {
  return std::to_string(soup.points.size()) + " vertices and " + std::to_string(soup.polygons.size()) +
         " faces";
}

// Files read and found to have one and the same topology, that of the first.
std::vector<MeshSoup> readFiles(const MeshSequence& sequence, int begin, int end) {
  std::vector<MeshSoup> files;
  for (int n = begin; n <= end; ++n) {
    MeshSoup soup = readSoup(sequence.fileOf(n));
    if (!files.empty()) {
      const MeshSoup& first = files.front();
      const auto fail = [&](const std::string& how) {
        failDifferent(sequence.fileOf(n), sequence.fileOf(begin), how);
      };
      if (sizeOf(soup) != sizeOf(first)) fail("has " + sizeOf(soup) + ", not " + sizeOf(first) + " as");
      const auto other = std::mismatch(soup.polygons.begin(), soup.polygons.end(), first.polygons.begin());
      if (other.first != soup.polygons.end())
        fail("its face " + std::to_string(other.first - soup.polygons.begin() + 1) +
             " joins other vertices than in");
      soup.polygons.clear();
    }
    files.push_back(std::move(soup));
  }
  return files;
}

// For each vertex the first one that lies at the same place in all files.
std::vector<std::size_t> joined(const std::vector<MeshSoup>& files) {
  const auto compare = [&](std::size_t a, std::size_t b) {
    for (const MeshSoup& file : files) {
      const Vec3d &x = file.points[a], &y = file.points[b];
      for (int axis = 0; axis < 3; ++axis)
        if (x[axis] != y[axis]) return x[axis] < y[axis] ? -1 : 1;
    }
    return 0;
  };
  std::vector<std::size_t> order(files.front().points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const int sign = compare(a, b);
    return sign != 0 ? sign < 0 : a < b;
  });
  std::vector<std::size_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && compare(order[i - 1], order[i]) == 0;
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

// Its corners by their joined vertices, without those that are the same as the one before.
Corners cleaned(Corners polygon, const std::vector<std::size_t>& vertexOf) {
  for (std::size_t& corner : polygon) corner = vertexOf[corner];
  return withoutRepeats(polygon);
}

double volumeOf(const std::vector<Vec3f>& x, const std::vector<Vec3I>& triangles) {
  double sixfold = 0.0;
  for (const Vec3I& t : triangles) sixfold += Vec3d(x[t[0]]).dot(Vec3d(x[t[1]]).cross(Vec3d(x[t[2]])));
  return sixfold / 6.0;
}

}  // namespace

MovingMesh::MovingMesh(const MeshSequence& sequence) : MovingMesh(sequence, 0, sequence.count() - 1) {}

MovingMesh::MovingMesh(const MeshSequence& sequence, int begin, int end) : m_begin(begin) {
  const std::vector<MeshSoup> files = readFiles(sequence, begin, end);
  const std::vector<Vec3d>& points = files.front().points;
  const std::vector<std::size_t> vertexOf = joined(files);
  std::vector<Corners> polygons;
  for (const Corners& polygon : files.front().polygons) {
    Corners corners = cleaned(polygon, vertexOf);
    if (corners.size() >= 3) polygons.push_back(std::move(corners));
  }
  const std::filesystem::path name = sequence.fileOf(begin);
  if (polygons.empty()) throw MeshError(name.string() + ": all its faces are degenerate");
  polygons = withoutTwins(polygons);
  checkClosed(name, polygons);

  for (const Corners& polygon : polygons) {
    std::vector<Vec3d> x;
    for (const std::size_t corner : polygon) x.push_back(points[corner]);
    const std::size_t start = bestFan(x).start, n = polygon.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const auto corner = [&](std::size_t k) {
        return static_cast<openvdb::Index32>(polygon[(start + k) % n]);
      };
      m_triangles.emplace_back(corner(0), corner(i), corner(i + 1));
    }
  }
  std::erase_if(m_triangles, [](const Vec3I& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  for (int n = begin; n <= end; ++n)
    m_positions.push_back(placedPoints(sequence.fileOf(n), files[std::size_t(n - begin)], sequence.place));
  // As it is turned where it is largest: elsewhere it may be folded flat.
  const auto largest =
      std::max_element(m_positions.begin(), m_positions.end(), [&](const auto& a, const auto& b) {
        return std::abs(volumeOf(a, m_triangles)) < std::abs(volumeOf(b, m_triangles));
      });
  m_triangles = outwardTriangles(name, {*largest, m_triangles});
}

TriangleMesh MovingMesh::at(int file, double part) const {
  TriangleMesh mesh{m_positions[file - m_begin], m_triangles};
  if (part == 0.0) return mesh;
  const std::vector<Vec3f>& next = m_positions[file + 1 - m_begin];
  for (std::size_t i = 0; i < next.size(); ++i)
    mesh.positions[i] = Vec3f((1.0 - part) * Vec3d(mesh.positions[i]) + part * Vec3d(next[i]));
  return mesh;
}

std::vector<Vec3f> MovingMesh::change(int file) const {
  const std::vector<Vec3f>& from = m_positions[file - m_begin];
  std::vector<Vec3f> change = m_positions[file + 1 - m_begin];
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= from[i];
  return change;
}

}  // namespace fluidtex::sim
