#include "tests/caches/liquid/geometry_bytes.h"

#include <fmt/core.h>

namespace fluidtex::caches {
namespace {

using openvdb::Vec3d;
using openvdb::Vec3I;

constexpr std::endian kBig = std::endian::big;

std::vector<double> numbersOf(const std::vector<Vec3I>& triangles) {
  std::vector<double> numbers;
  for (const Vec3I& t : triangles)
    for (int corner = 0; corner < 3; ++corner) numbers.push_back(t[corner]);
  return numbers;
}

}  // namespace

std::vector<double> numbersOf(const std::vector<Vec3d>& vectors, double factor) {
  std::vector<double> numbers;
  for (const Vec3d& v : vectors)
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(factor * v[axis]);
  return numbers;
}

std::string withCount(std::size_t count, const std::string& bytes) {
  std::string result;
  put(result, std::int32_t(count));
  return result + bytes;
}

std::string bobjBytes(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, bool normals) {
  std::string bytes = withCount(points.size(), bytesOf<float>(numbersOf(points)));
  if (normals) bytes += withCount(points.size(), bytesOf<float>(numbersOf(points)));
  return bytes + withCount(triangles.size(), bytesOf<std::int32_t>(numbersOf(triangles)));
}

std::string vtkBytes(const std::vector<Vec3d>& points, const std::vector<Vec3d>& velocities) {
  const std::size_t count = points.size();
  std::string bytes = "# vtk DataFile Version 4.1\nparticles\nBINARY\nDATASET UNSTRUCTURED_GRID\n";
  bytes +=
      fmt::format("POINTS {} float\n", count) + fluidtex::caches::bytesOf<float>(numbersOf(points), kBig);
  bytes += fmt::format("\nCELLS {} {}\n", count, 2 * count);
  for (std::size_t n = 0; n < count; ++n) {
    put(bytes, std::int32_t(1), kBig);
    put(bytes, std::int32_t(n), kBig);
  }
  bytes += fmt::format("\nCELL_TYPES {}\n", count);
  for (std::size_t n = 0; n < count; ++n) put(bytes, std::int32_t(1), kBig);
  bytes += fmt::format("\nPOINT_DATA {}\nFIELD FieldData 1\nvelocity 3 {} float\n", count, count);
  return bytes + fluidtex::caches::bytesOf<float>(numbersOf(velocities), kBig) + "\n";
}

std::string plyBytes(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                     const std::vector<Vec3d>& velocities) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n";
  bytes += fmt::format("element vertex {}\n", points.size());
  for (const char* name : {"x", "y", "z"}) bytes += fmt::format("property float {}\n", name);
  if (!velocities.empty())
    for (const char* name : {"vx", "vy", "vz"}) bytes += fmt::format("property float {}\n", name);
  bytes +=
      fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", triangles.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    bytes += fluidtex::caches::bytesOf<float>({points[n][0], points[n][1], points[n][2]});
    if (!velocities.empty())
      bytes += fluidtex::caches::bytesOf<float>({velocities[n][0], velocities[n][1], velocities[n][2]});
  }
  for (const Vec3I& t : triangles) {
    put(bytes, std::uint8_t(3));
    bytes += fluidtex::caches::bytesOf<std::int32_t>({double(t[0]), double(t[1]), double(t[2])});
  }
  return bytes;
}

}  // namespace fluidtex::caches
