// Blender, source/blender/blenkernel/intern/fluid.c and extern/mantaflow: int32 n, n x 3 float positions; the
// same of normals; int32 m, m x 3 int32 corners. FLIP Fluids, trianglemesh.cpp: without normals; its vectors
// have no triangles either, and, by version, a number of triangles of 0 or none.
#include "caches/formats/build_geometry.h"
#include "caches/formats/geometry_formats.h"
#include "caches/formats/numbers.h"

namespace fluidtex::caches {

namespace {

constexpr std::uint64_t kRow = 12;  // three floats, or three corners

// A number of rows, for which the rest of the file is long enough.
std::uint64_t takeCount(Bytes& bytes, const char* what) {
  const auto count = bytes.take<std::int32_t>();
  if (count < 0 || std::uint64_t(count) * kRow > bytes.size())
    throw std::runtime_error("says that it has " + std::to_string(count) + " " + what + ", and " +
                             counted(bytes.size(), "byte") +
                             " follow, 12 of which are one; write or copy it anew");
  return std::uint64_t(count);
}

}  // namespace

Geometry geometryOfBobj(std::string_view whole) {
  Bytes bytes(whole, std::endian::little);
  Geometry geometry;
  const std::uint64_t points = takeCount(bytes, "points");
  geometry.points.resize(points);
  const std::string_view positions = bytes.take(points * kRow);
  if (points > 0) std::memcpy(geometry.points.data(), positions.data(), positions.size());
  if (bytes.size() == 0) return geometry;

  // With a count each, a file of normals and triangles is four bytes more than a multiple of rows.
  if (bytes.size() % kRow == 8) {
    const std::uint64_t normals = takeCount(bytes, "normals");
    if (normals != points)
      throw std::runtime_error("has " + counted(points, "point") + " and " + counted(normals, "normal") +
                               "; there is a normal at each point or none at all");
    bytes.take(normals * kRow);
  }
  const std::uint64_t triangles = takeCount(bytes, "triangles");
  if (bytes.size() != triangles * kRow)
    throw std::runtime_error(
        "has " + counted(points, "point") + " and " + counted(triangles, "triangle") + ", behind which are " +
        std::to_string(bytes.size() - triangles * kRow) +
        " bytes too many; expected points alone, points and triangles (FLIP Fluids), or points, "
        "normals and triangles (Blender)");
  geometry.triangles.reserve(triangles);
  const auto corners =
      numbersOf<std::int64_t>(bytes.take(bytes.size()), NumberType::int32, std::endian::little);
  for (std::size_t n = 0; n < triangles; ++n) addPolygon(std::span(corners).subspan(3 * n, 3), n, geometry);
  return geometry;
}

}  // namespace fluidtex::caches
