// The triangles of a surface in units of cells, and the distance to one of them.
#pragma once

#include "caches/liquid/surface_mesh.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::caches {

// Places count in cells from the centre of the cell `origin`, the lowest one of a block of 8^3: rounded to
// floats once, so that all that is asked of the triangles is asked of the same ones.
struct CellTriangles {
  openvdb::Coord origin{0};
  std::vector<openvdb::Vec3f> points;  // #P; those that are not finite, or beyond 1e9 cells, are NaN
  // #T. Where there are more points than triangles, as of triangles with corners of their own, corners in the
  // same place all have the first one's number. Those that count for nothing have one corner three times:
  // where one is no number, and where they are lower than a millionth of a cell.
  std::vector<openvdb::Vec3I> triangles;
  // The other triangles around point p: ring[ringFirst[p]] to ring[ringFirst[p + 1] - 1], ascending.
  std::vector<std::uint32_t> ringFirst, ring;

  bool counts(std::uint32_t triangle) const { return triangles[triangle][0] != triangles[triangle][1]; }

  std::span<const std::uint32_t> around(std::uint32_t point) const {
    return std::span(ring).subspan(ringFirst[point], ringFirst[point + 1] - ringFirst[point]);
  }
};

// What passes a triangle's edge at this distance touches it, cells.
inline constexpr double kTouch = 1e-6;

CellTriangles cellTriangles(const SurfaceTriangles& surface, double h);

// The closest point of a triangle.
struct TrianglePoint {
  double square = 0.0;         // of the distance, cells
  openvdb::Vec3d weight{0.0};  // of the corners: 0 is exact where it lies on an edge or a corner
  openvdb::Vec3d offset{0.0};  // from the place to it, cells
};
TrianglePoint closestPoint(const CellTriangles& surface, std::uint32_t triangle, const openvdb::Vec3d& place);

// A triangle that may be the closest to a place, and the square of its distance (cells).
struct Nearest {
  float square = 0.0f;
  std::uint32_t triangle = 0;
};

// From a triangle and its closest point over edges and corners to others, as long as they come nearer: where
// the surface bends smoothly, to the closest triangle of all that are as near as this one.
Nearest descend(const CellTriangles& surface, const openvdb::Vec3d& place, std::uint32_t triangle,
                TrianglePoint closest);

}  // namespace fluidtex::caches
