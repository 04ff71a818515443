// FLIP Fluids, bakefiles: little-endian, without a header.
#include "caches/formats/flip_fluids.h"

#include "caches/formats/file_content.h"
#include "caches/formats/geometry_formats.h"

#include <string>

namespace fluidtex::caches {

namespace {

[[noreturn]] void failAt(const std::filesystem::path& file, std::size_t vertex) {
  fail(file, "the value of vertex " + std::to_string(vertex + 1) + " is not finite; bake it anew");
}

}  // namespace

std::vector<openvdb::Vec3f> readFlipVectors(const std::filesystem::path& file) {
  const std::string content = contentOf(file);
  Geometry geometry;
  try {
    geometry = geometryOfBobj(content);
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
  if (!geometry.triangles.empty()) fail(file, "holds a mesh; expected vectors, as in velocity000001.bobj");
  for (std::size_t n = 0; n < geometry.points.size(); ++n)
    if (!geometry.points[n].isFinite()) failAt(file, n);
  return std::move(geometry.points);
}

}  // namespace fluidtex::caches
