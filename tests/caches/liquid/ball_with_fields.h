// A ball as a mesh or as particles, with further fields at its points.
#pragma once

#include "tests/caches/liquid/cache_files.h"

#include <fmt/format.h>

#include <limits>

namespace fluidtex::caches {

// What the fields hold at a place of the world.
inline double heatAt(const Vec3d& x) {
  return 300.0 + 50.0 * x[0] - 20.0 * x[2];
}

// A mesh, or particles, of a ball as PLY in text, with heat and a direction (y up in neither) at its points.
inline std::string plyWithFields(const std::vector<Vec3d>& points,
                                 const std::vector<openvdb::Vec3I>& triangles,
                                 std::size_t noNumber = std::numeric_limits<std::size_t>::max()) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty "
      "float z\nproperty float heat\nproperty float Cd_x\nproperty float Cd_y\nproperty float "
      "Cd_z\n",
      points.size());
  if (!triangles.empty())
    text += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", triangles.size());
  text += "end_header\n";
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3d& x = points[n];
    text += fmt::format("{} {} {} {} {} {} 1\n", x[0], x[1], x[2],
                        n == noNumber ? "nan" : fmt::format("{}", heatAt(x)), x[0], x[1]);
  }
  for (const openvdb::Vec3I& t : triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

inline Cache cacheAt(const std::filesystem::path& path, Options options = {}) {
  options.path = path;
  return {options, recognize(options), 0.03, 24.0};
}

struct BallMesh {
  std::vector<Vec3d> points;
  std::vector<openvdb::Vec3I> triangles;
};

inline BallMesh writeBall(const std::filesystem::path& file, int halvings) {
  BallMesh ball;
  ballMesh({}, halvings, ball.points, ball.triangles);
  writeBytes(file, plyWithFields(ball.points, ball.triangles));
  return ball;
}

}  // namespace fluidtex::caches
