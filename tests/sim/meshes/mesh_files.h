// Meshes as text, files of meshes that change their shape, and what is known of a mesh.
#pragma once

#include "sim/meshes/read_mesh.h"
#include "sim/options.h"
#include "sim/shapes/shape_distance.h"
#include "tests/sim/meshes/written_files.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fluidtex::sim {

inline const std::string kBoxFaces = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

inline std::string vertex(double x, double y, double z) {
  return "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
}

inline std::string boxObj(const Vec3d& a, const Vec3d& b, const std::string& faces = kBoxFaces) {
  std::string text;
  for (const double z : {a.z(), b.z()})
    text +=
        vertex(a.x(), a.y(), z) + vertex(b.x(), a.y(), z) + vertex(b.x(), b.y(), z) + vertex(a.x(), b.y(), z);
  return text + faces;
}

// The corners of a box alone.
inline std::string boxCorners(const Vec3d& low, const Vec3d& high) {
  return boxObj(low, high, "");
}

// A box's faces, its first vertex having the number `first`; turned inward if asked for.
inline std::string facesFrom(int first, bool inward = false) {
  std::string text, line;
  for (const char c : kBoxFaces) {
    if (c == '\n') {
      text += "f" + line + "\n";
      line.clear();
    } else if (c >= '1' && c <= '8') {
      const std::string corner = " " + std::to_string(c - '1' + first);
      line = inward ? corner + line : line + corner;
    }
  }
  return text;
}

// Boxes in one file.
inline std::string boxes(const std::vector<openvdb::BBoxd>& all) {
  std::string text, faces;
  for (std::size_t n = 0; n < all.size(); ++n) {
    text += boxCorners(all[n].min(), all[n].max());
    faces += facesFrom(int(8 * n) + 1);
  }
  return text + faces;
}

// A prism over an L: of volume 3, its ends concave.
inline std::string prismObj() {
  std::string text;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})
      text += vertex(x, y, z);
  text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
  for (int n = 1; n <= 6; ++n) {
    const int next = n % 6 + 1;
    text += "f " + std::to_string(n) + " " + std::to_string(next) + " " + std::to_string(next + 6) + " " +
            std::to_string(n + 6) + "\n";
  }
  return text;
}

// Files 1, 2, ... in a folder that is gone when the test ends.
struct Files {
  std::filesystem::path folder;
  MeshSequence sequence;
  explicit Files(const std::vector<std::string>& texts, const std::string& name = "box_%02d.obj") {
    static int number = 0;
    folder = std::filesystem::temp_directory_path() /
             ("fluidtex_100%d_" + std::to_string(::getpid()) + "_" + std::to_string(++number));
    std::filesystem::create_directories(folder);
    sequence.files = folder / name;
    sequence.last = static_cast<int>(texts.size());
    for (std::size_t n = 0; n < texts.size(); ++n)
      std::ofstream(sequence.fileOf(static_cast<int>(n)), std::ios::binary) << texts[n];
  }
  ~Files() { std::filesystem::remove_all(folder); }
};

// Whether every edge is met as often in one direction as in the other.
inline bool isClosed(const TriangleMesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const unsigned a = t[i], b = t[(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

inline double volumeOf(const TriangleMesh& mesh) {
  double sixfold = 0.0;
  for (const auto& t : mesh.triangles)
    sixfold +=
        Vec3d(mesh.positions[t[0]]).dot(Vec3d(mesh.positions[t[1]]).cross(Vec3d(mesh.positions[t[2]])));
  return sixfold / 6.0;
}

inline TriangleMesh meshOf(const std::string& name, const std::string& content, double scale = 1.0) {
  const WrittenFile file(name, content);
  return readMesh(MeshShape{file.path, {.scale = scale}});
}

inline Solid solidOf(const MeshSequence& sequence) {
  Solid solid;
  solid.shape.kind = sequence;
  return solid;
}

}  // namespace fluidtex::sim
