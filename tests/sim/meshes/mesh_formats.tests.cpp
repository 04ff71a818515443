// One mesh in every format, read as scenes read it.
#include "sim/meshes/mesh_formats.h"

#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <utility>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

// A tetrahedron with three edges of 0.3 along the axes from (0.2, 0.2, 0.2): volume 0.0045.
constexpr double kTetrahedron = 0.0045;
const std::vector<std::array<float, 3>> kCorners{
    {0.2f, 0.2f, 0.2f}, {0.5f, 0.2f, 0.2f}, {0.2f, 0.5f, 0.2f}, {0.2f, 0.2f, 0.5f}};
const std::vector<std::array<int, 3>> kFaces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string asObj(std::size_t faces = 4) {
  std::string text = "# tetrahedron\n";
  for (const auto& p : kCorners) {
    text += "v " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  for (std::size_t i = 0; i < faces; ++i) {
    const auto& f = kFaces[i];
    text += "f " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " +
            std::to_string(f[2] + 1) + "\n";
  }
  return text;
}

std::string plyHeader(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string asAsciiPly() {
  std::string text = plyHeader("ascii");
  for (const auto& p : kCorners) {
    text += std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
  }
  for (const auto& f : kFaces) {
    text += "3 " + std::to_string(f[0]) + " " + std::to_string(f[1]) + " " + std::to_string(f[2]) + "\n";
  }
  return text;
}

std::string asBinaryPly() {
  std::string bytes = plyHeader("binary_little_endian");
  for (const auto& p : kCorners) append(bytes, p);
  for (const auto& f : kFaces) {
    append(bytes, std::uint8_t{3});
    append(bytes, f);
  }
  return bytes;
}

std::string asBinaryStl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t{4});
  for (const auto& f : kFaces) {
    append(bytes, std::array<float, 3>{0, 0, 0});
    for (const int v : f) append(bytes, kCorners[v]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string asAsciiStl() {
  std::string text = "solid tetrahedron\n";
  for (const auto& f : kFaces) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : f) {
      text += "vertex " + std::to_string(kCorners[v][0]) + " " + std::to_string(kCorners[v][1]) + " " +
              std::to_string(kCorners[v][2]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

}  // namespace

TEST_CASE("mesh formats: every format gives the same closed, outward mesh", "[sim]") {
  const auto [name, content] = GENERATE(table<std::string, std::string>({{"t.obj", asObj()},
                                                                         {"t.ply", asAsciiPly()},
                                                                         {"b.ply", asBinaryPly()},
                                                                         {"t.stl", asAsciiStl()},
                                                                         {"b.stl", asBinaryStl()},
                                                                         {"upper.OBJ", asObj()}}));
  CAPTURE(name);
  const WrittenFile file(name, content);
  const TriangleMesh mesh = readMesh(MeshShape{file.path});
  CHECK(mesh.positions.size() == 4);
  CHECK(mesh.triangles.size() == 4);
  CHECK(isClosed(mesh));
  CHECK_THAT(volumeOf(mesh), WithinAbs(kTetrahedron, 1e-8));
}

TEST_CASE("mesh formats: inside-out faces are turned, polygons are split, negative scale mirrors", "[sim]") {
  const WrittenFile flipped("flipped.obj",
                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  CHECK_THAT(volumeOf(readMesh(MeshShape{flipped.path})), WithinAbs(1.0 / 6.0, 1e-7));
  const WrittenFile cube("cube.obj",
                         "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const TriangleMesh mesh = readMesh(MeshShape{cube.path, {.scale = -2.0}});
  CHECK(mesh.triangles.size() == 12);
  CHECK(isClosed(mesh));
  CHECK_THAT(volumeOf(mesh), WithinAbs(8.0, 1e-5));
}

TEST_CASE("mesh formats: y up becomes z, then the mesh is turned, scaled and moved", "[sim]") {
  const WrittenFile file("wedge.obj",
                         "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto placed = [&](const MeshPlace& place) { return readMesh(MeshShape{file.path, place}).positions; };
  const auto holds = [](const std::vector<openvdb::Vec3f>& positions, const Vec3d& x) {
    return std::any_of(positions.begin(), positions.end(),
                       [&](const openvdb::Vec3f& p) { return (Vec3d(p) - x).length() < 1e-6; });
  };
  const auto upright = placed({.up = UpAxis::y});
  CHECK(holds(upright, Vec3d(1, 0, 0)));
  CHECK(holds(upright, Vec3d(0, 0, 2)));
  CHECK(holds(upright, Vec3d(0, -3, 0)));
  CHECK_THAT(volumeOf(readMesh(MeshShape{file.path, {.up = UpAxis::y}})), WithinAbs(1.0, 1e-6));
  // About x first: z comes to lie along -y, and about z then along x.
  const auto turned = placed({.rotate = Vec3d(90, 0, 90), .scale = 2.0, .translate = Vec3d(1, 1, 1)});
  CHECK(holds(turned, Vec3d(1, 3, 1)));  // x
  CHECK(holds(turned, Vec3d(1, 1, 5)));  // y
  CHECK(holds(turned, Vec3d(7, 1, 1)));  // z
}

TEST_CASE("mesh formats: faults name the file and what is wrong", "[sim]") {
  const auto faultOf = [](const std::filesystem::path& path) -> std::string {
    try {
      readMesh(MeshShape{path});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no fault";
  };
  CHECK_THAT(faultOf("/nowhere/duck.obj"), Contains("duck.obj") && Contains("no such file"));
  CHECK_THAT(faultOf(std::filesystem::temp_directory_path()), Contains("not a file"));
  const WrittenFile empty("empty.ply", "");
  CHECK_THAT(faultOf(empty.path), Contains("empty.ply") && Contains("empty"));
  const WrittenFile kind("mesh.fbx", "x");
  CHECK_THAT(faultOf(kind.path), Contains(".fbx") && Contains(".stl"));
  const WrittenFile open("open.obj", asObj(3));
  CHECK_THAT(faultOf(open.path),
             Contains("open.obj") && Contains("not closed: 3 edges") && Contains("; close it, in Blender"));
  const WrittenFile pointsOnly("points.obj", asObj(0));
  CHECK_THAT(faultOf(pointsOnly.path), Contains("no faces"));
  const WrittenFile outOfRange("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  CHECK_THAT(faultOf(outOfRange.path), Contains("range.obj"));
  CHECK(faultOf(outOfRange.path) != "no fault");
  for (const char* extension : {"obj", "ply", "stl"}) {
    const WrittenFile garbage(std::string("garbage.") + extension, "\x01\x02 this is no mesh \xff\xfe\n\n7");
    CAPTURE(extension, faultOf(garbage.path));
    CHECK_THAT(faultOf(garbage.path), Contains("garbage"));
  }
}

TEST_CASE("mesh formats: no shorter file is taken for a closed mesh", "[sim]") {
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"cut.ply", asBinaryPly()},
                                      {"cut.stl", asBinaryStl()},
                                      {"cut2.ply", asAsciiPly()}}) {
    for (std::size_t length = 0; length + 8 < content.size(); length += 5) {
      const WrittenFile file(name, content.substr(0, length));
      CAPTURE(name, length);
      REQUIRE_THROWS_AS(readMesh(MeshShape{file.path}), std::runtime_error);
    }
  }
}
