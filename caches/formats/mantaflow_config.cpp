// Blender, extern/mantaflow, fileio/iogrids and MANTA_main.cpp: the fields one behind the other,
// little-endian.
#include "caches/formats/mantaflow_config.h"

#include "caches/formats/file_content.h"
#include "caches/formats/numbers.h"

#include <string>

namespace fluidtex::caches {

namespace {

constexpr std::size_t kSize = 204;
// Of a side: what Blender offers.
constexpr int kMostCells = 10000;
constexpr std::string_view kEnd("C01\0", 4);

openvdb::Coord takeCoord(Bytes& bytes) {
  const auto i = bytes.take<std::int32_t>(), j = bytes.take<std::int32_t>(), k = bytes.take<std::int32_t>();
  return {i, j, k};
}

openvdb::Vec3f takeVector(Bytes& bytes) {
  const auto x = bytes.take<float>(), y = bytes.take<float>(), z = bytes.take<float>();
  return {x, y, z};
}

// Column by column of a matrix that is multiplied with column vectors: row by row of OpenVDB's.
openvdb::Mat4d takeMatrix(Bytes& bytes) {
  openvdb::Mat4d matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix(row, column) = bytes.take<float>();
  return matrix;
}

}  // namespace

MantaflowConfig readMantaflowConfig(const std::filesystem::path& file) {
  const std::string content = contentOf(file);
  if (content.size() != kSize || !content.ends_with(kEnd))
    fail(file, "is no configuration of a Blender liquid cache, of 204 bytes that end with 'C01'; it has " +
                   std::to_string(content.size()));
  Bytes bytes(content, std::endian::little);
  MantaflowConfig config;
  config.activeFields = bytes.take<std::int32_t>();
  config.resolution = takeCoord(bytes);
  config.dx = bytes.take<float>();
  config.dt = bytes.take<float>();
  config.p0 = takeVector(bytes);
  config.p1 = takeVector(bytes);
  config.dp0 = takeVector(bytes);
  config.shift = takeCoord(bytes);
  config.shiftedBy = takeVector(bytes);
  config.worldFromObject = takeMatrix(bytes);
  config.baseResolution = takeCoord(bytes);
  config.firstCell = takeCoord(bytes);
  config.behindLastCell = takeCoord(bytes);
  config.color = takeVector(bytes);
  config.time = bytes.take<float>();

  if (!std::isfinite(config.dx) || !std::isfinite(config.dt) || !std::isfinite(config.time) ||
      !config.p0.isFinite() || !config.p1.isFinite() || !config.worldFromObject.isFinite())
    fail(file, "holds numbers that are not finite; bake the cache anew");
  const openvdb::Coord& cells = config.resolution;
  const auto fits = [](int n) { return n >= 1 && n <= kMostCells; };
  if (!fits(cells.x()) || !fits(cells.y()) || !fits(cells.z()) || !(config.dx > 0.0f) ||
      !((config.p1 - config.p0).lengthSqr() > 0.0f))
    fail(file, "has no domain: its resolution is " + std::to_string(cells.x()) + " x " +
                   std::to_string(cells.y()) + " x " + std::to_string(cells.z()) + " cells, of edge " +
                   std::to_string(config.dx) + "; all are above 0, and no more than " +
                   std::to_string(kMostCells) + " cells");
  return config;
}

}  // namespace fluidtex::caches
