#include "sim/shapes/shape_distance.h"
#include "sim/meshes/read_mesh.h"
#include "sim/shapes/shape_triangles.h"

#include <unistd.h>
#include <catch2/catch.hpp>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

const openvdb::BBoxd kDomain(Vec3d(0.0), Vec3d(2.0, 1.5, 1.0));
constexpr double kVoxel = 0.05;

double volumeOf(const TriangleMesh& mesh) {
  double sixfold = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    sixfold += a.dot(b.cross(c));
  }
  return sixfold / 6.0;
}

// Every directed edge is met once, and once the other way round.
bool isClosed(const TriangleMesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> balance;
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const unsigned a = t[i], b = t[(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

// A file that is gone when the test ends.
struct TemporaryFile {
  std::filesystem::path path;
  TemporaryFile(const std::string& name, const std::string& content)
      : path(std::filesystem::temp_directory_path() /
             ("fluidtex_" + std::to_string(::getpid()) + "_" + name)) {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

// A tetrahedron with three edges of 0.3 along the axes from (0.2, 0.2, 0.2): volume 0.0045.
constexpr double kTetrahedron = 0.0045;
const std::vector<std::array<float, 3>> kCorners{
    {0.2f, 0.2f, 0.2f}, {0.5f, 0.2f, 0.2f}, {0.2f, 0.5f, 0.2f}, {0.2f, 0.2f, 0.5f}};
const std::vector<std::array<int, 3>> kFaces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

template <typename Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

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

TEST_CASE("shape distances: closed forms of single shapes", "[sim]") {
  const ShapeDistance box(Shape{Box{Vec3d(0, 0, 0), Vec3d(1, 2, 3)}}, kVoxel);
  CHECK_THAT(box(Vec3d(0.25, 1, 1.5)), WithinAbs(-0.25, 1e-12));
  CHECK_THAT(box(Vec3d(1.5, 1, 1)), WithinAbs(0.5, 1e-12));
  CHECK_THAT(box(Vec3d(4, 6, 3)), WithinAbs(5.0, 1e-12));  // 3-4-5 beyond an edge
  CHECK_THAT(box(Vec3d(-1, -2, -2)), WithinAbs(3.0, 1e-12));

  const ShapeDistance sphere(Shape{Sphere{Vec3d(1, 1, 1), 0.5}}, kVoxel);
  CHECK_THAT(sphere(Vec3d(1, 1, 1)), WithinAbs(-0.5, 1e-12));
  CHECK_THAT(sphere(Vec3d(1, 4, 5)), WithinAbs(4.5, 1e-12));

  const ShapeDistance plane(Shape{HalfSpace{Vec3d(0, 0, 1), Vec3d(0, 3, 4)}},
                            kVoxel);  // the normal need not be unit
  CHECK_THAT(plane(Vec3d(7, 0, 1)), WithinAbs(0.0, 1e-12));
  CHECK_THAT(plane(Vec3d(7, 3, 5)), WithinAbs(5.0, 1e-12));
  CHECK_THAT(plane(Vec3d(7, 0, 0)), WithinAbs(-0.8, 1e-12));
  CHECK_THROWS(ShapeDistance(Shape{HalfSpace{Vec3d(0.0), Vec3d(0.0)}}, kVoxel));
}

TEST_CASE("shape distances: unions and differences keep the sign and never overstate", "[sim]") {
  const Shape left{Box{Vec3d(0.0), Vec3d(1.0)}}, right{Sphere{Vec3d(1.0, 0.5, 0.5), 0.4}};
  const ShapeDistance a(left, kVoxel), b(right, kVoxel);
  const ShapeDistance both(Shape{Union{{left, right}}}, kVoxel),
      less(Shape{Difference{{left, right}}}, kVoxel);
  for (double x = -0.5; x < 2.0; x += 0.11) {
    for (double y = -0.5; y < 1.5; y += 0.13) {
      const Vec3d p(x, y, 0.45);
      REQUIRE((both(p) < 0.0) == (a(p) < 0.0 || b(p) < 0.0));
      REQUIRE((less(p) < 0.0) == (a(p) < 0.0 && b(p) > 0.0));
      REQUIRE(both(p) == std::min(a(p), b(p)));
    }
  }
}

TEST_CASE("shape distances: a mesh as its closed form, to a voxel's curvature", "[sim]") {
  const TemporaryFile file("tetrahedron.obj", asObj());
  const double h = 0.02;
  const ShapeDistance mesh(Shape{MeshShape{file.path}}, h);
  CHECK_THAT(mesh(Vec3d(0.25, 0.25, 0.15)), WithinAbs(0.05, 1e-3));
  CHECK_THAT(mesh(Vec3d(0.25, 0.28, 0.22)), WithinAbs(-0.02, 1e-3));
  CHECK_THAT(mesh(Vec3d(0.33, 0.33, 0.33)),
             WithinAbs(0.09 / std::sqrt(3.0), 1e-3));  // x+y+z = 0.9 is the slanted face
  CHECK(mesh(Vec3d(5, 5, 5)) > 0.0);

  const ShapeDistance moved(Shape{MeshShape{file.path, 2.0, Vec3d(1, 0, 0)}}, h);
  CHECK_THAT(moved(Vec3d(1.5, 0.5, 0.3)), WithinAbs(0.1, 1e-3));
}

TEST_CASE("mesh reader: every format gives the same closed, outward mesh", "[sim]") {
  const auto [name, content] = GENERATE(table<std::string, std::string>({{"t.obj", asObj()},
                                                                         {"t.ply", asAsciiPly()},
                                                                         {"b.ply", asBinaryPly()},
                                                                         {"t.stl", asAsciiStl()},
                                                                         {"b.stl", asBinaryStl()},
                                                                         {"upper.OBJ", asObj()}}));
  CAPTURE(name);
  const TemporaryFile file(name, content);
  const TriangleMesh mesh = readMesh(MeshShape{file.path});
  CHECK(mesh.positions.size() == 4);
  CHECK(mesh.triangles.size() == 4);
  CHECK(isClosed(mesh));
  CHECK_THAT(volumeOf(mesh), WithinAbs(kTetrahedron, 1e-8));
}

TEST_CASE("mesh reader: inside-out faces are turned, polygons are split, negative scale mirrors", "[sim]") {
  const TemporaryFile flipped("flipped.obj",
                              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  CHECK_THAT(volumeOf(readMesh(MeshShape{flipped.path})), WithinAbs(1.0 / 6.0, 1e-7));
  const TemporaryFile cube("cube.obj",
                           "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                           "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  const TriangleMesh mesh = readMesh(MeshShape{cube.path, -2.0, Vec3d(0.0)});
  CHECK(mesh.triangles.size() == 12);
  CHECK(isClosed(mesh));
  CHECK_THAT(volumeOf(mesh), WithinAbs(8.0, 1e-5));
}

TEST_CASE("mesh reader: faults name the file and what is wrong", "[sim]") {
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
  const TemporaryFile empty("empty.ply", "");
  CHECK_THAT(faultOf(empty.path), Contains("empty.ply") && Contains("empty"));
  const TemporaryFile kind("mesh.fbx", "x");
  CHECK_THAT(faultOf(kind.path), Contains(".fbx") && Contains(".stl"));
  const TemporaryFile open("open.obj", asObj(3));
  CHECK_THAT(faultOf(open.path), Contains("open.obj") && Contains("not closed: 3 edges"));
  const TemporaryFile pointsOnly("points.obj", asObj(0));
  CHECK_THAT(faultOf(pointsOnly.path), Contains("no faces"));
  const TemporaryFile outOfRange("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  CHECK_THAT(faultOf(outOfRange.path), Contains("range.obj"));
  CHECK(faultOf(outOfRange.path) != "no fault");
  for (const char* extension : {"obj", "ply", "stl"}) {
    const TemporaryFile garbage(std::string("garbage.") + extension,
                                "\x01\x02 this is no mesh \xff\xfe\n\n7");
    CAPTURE(extension, faultOf(garbage.path));
    CHECK_THAT(faultOf(garbage.path), Contains("garbage"));
  }
}

TEST_CASE("mesh reader: no shorter file is taken for a closed mesh", "[sim]") {
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"cut.ply", asBinaryPly()},
                                      {"cut.stl", asBinaryStl()},
                                      {"cut2.ply", asAsciiPly()}}) {
    for (std::size_t length = 0; length + 8 < content.size(); length += 5) {
      const TemporaryFile file(name, content.substr(0, length));
      CAPTURE(name, length);
      REQUIRE_THROWS_AS(readMesh(MeshShape{file.path}), std::runtime_error);
    }
  }
}

TEST_CASE("triangulate: boxes are twelve triangles, cut at the domain", "[sim]") {
  const TriangleMesh box = triangulate(Shape{Box{Vec3d(0.25), Vec3d(0.75)}}, kDomain, kVoxel);
  CHECK(box.positions.size() == 8);
  CHECK(box.triangles.size() == 12);
  CHECK(isClosed(box));
  CHECK_THAT(volumeOf(box), WithinAbs(0.125, 1e-7));
  CHECK_THAT(volumeOf(triangulate(Shape{Box{Vec3d(-1.0), Vec3d(0.5)}}, kDomain, kVoxel)),
             WithinAbs(0.125, 1e-7));
  CHECK(triangulate(Shape{Box{Vec3d(3.0), Vec3d(4.0)}}, kDomain, kVoxel).triangles.empty());
}

TEST_CASE("triangulate: what moves is cut at the domain where it is, not where it began", "[sim]") {
  Solid solid;
  solid.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(-1.0, 0.0, 0.0), 0.0}};
  const auto volumeAt = [&](double t) { return volumeOf(triangulate(solid, t, kDomain, kVoxel)); };
  SECTION("a box comes in from the right") {
    solid.shape.kind = Box{Vec3d(2.0, 0.25, 0.25), Vec3d(2.5, 0.75, 0.75)};
    CHECK(volumeAt(0.0) == 0.0);
    CHECK_THAT(volumeAt(0.25), WithinAbs(0.0625, 1e-6));
    CHECK_THAT(volumeAt(1.0), WithinAbs(0.125, 1e-6));
  }
  SECTION("a turning one stays a box") {
    solid.shape.kind = Box{Vec3d(0.75, 0.5, 0.25), Vec3d(1.25, 1.0, 0.75)};
    solid.keyframes = {{0.0, Vec3d(0.0), 0.0}, {1.0, Vec3d(0.0), 45.0}};
    CHECK_THAT(volumeAt(0.5), WithinAbs(0.125, 1e-6));
    CHECK(isClosed(triangulate(solid, 0.5, kDomain, kVoxel)));
  }
  SECTION("a ball comes in from the right") {
    const double ball = 4.0 / 3.0 * std::numbers::pi * 0.027;
    solid.shape.kind = Sphere{Vec3d(2.0, 0.75, 0.5), 0.3};
    CHECK_THAT(volumeAt(0.0), WithinAbs(0.5 * ball, 0.05 * ball));
    CHECK_THAT(volumeAt(1.0), WithinAbs(ball, 0.02 * ball));
  }
}

TEST_CASE("triangulate: half-spaces are cut at the domain exactly", "[sim]") {
  const double whole = kDomain.volume();
  const auto mesh = [](const Vec3d& point, const Vec3d& normal) {
    return triangulate(Shape{HalfSpace{point, normal}}, kDomain, kVoxel);
  };
  // Through the middle: half of it, however tilted.
  for (const Vec3d& normal :
       {Vec3d(0, 0, 1), Vec3d(1, 2, 3), Vec3d(-1, 0.1, 0.2), Vec3d(0, -1, 1), Vec3d(1, 1, 1)}) {
    const TriangleMesh part = mesh(kDomain.getCenter(), normal);
    CAPTURE(normal.x(), normal.y(), normal.z());
    CHECK(isClosed(part));
    CHECK_THAT(volumeOf(part), WithinAbs(0.5 * whole, 1e-6));
  }
  // A corner: the tetrahedron x + y + z < 0.6. The rest: all but it.
  const TriangleMesh corner = mesh(Vec3d(0.6, 0, 0), Vec3d(1, 1, 1));
  CHECK(corner.triangles.size() == 4);
  CHECK_THAT(volumeOf(corner), WithinAbs(0.036, 1e-7));
  const TriangleMesh rest = mesh(Vec3d(0.6, 0, 0), Vec3d(-1, -1, -1));
  CHECK(isClosed(rest));
  CHECK_THAT(volumeOf(rest), WithinAbs(whole - 0.036, 1e-6));
  // All of the domain, none of it, and a plane that lies in a face.
  CHECK_THAT(volumeOf(mesh(Vec3d(0, 0, 7), Vec3d(0, 0, 1))), WithinAbs(whole, 1e-6));
  CHECK(mesh(Vec3d(0, 0, -7), Vec3d(0, 0, 1)).triangles.empty());
  CHECK(mesh(Vec3d(0, 0, 0), Vec3d(0, 0, 1)).triangles.empty());
  CHECK_THAT(volumeOf(mesh(Vec3d(0, 0, 1), Vec3d(0, 0, 1))), WithinAbs(whole, 1e-6));
}

TEST_CASE("triangulate: curved and combined shapes are closed, outward and of the right volume", "[sim]") {
  const Sphere ball{Vec3d(1.0, 0.75, 0.5), 0.3};
  const double ballVolume = 4.0 / 3.0 * std::numbers::pi * 0.027;
  const TriangleMesh sphere = triangulate(Shape{ball}, kDomain, kVoxel);
  CHECK(isClosed(sphere));
  CHECK_THAT(volumeOf(sphere), WithinAbs(ballVolume, 0.02 * ballVolume));
  for (const auto& x : sphere.positions)
    REQUIRE_THAT((Vec3d(x) - ball.center).length(), WithinAbs(0.3, 1e-6));

  const TriangleMesh cut = triangulate(Shape{Sphere{Vec3d(0.0, 0.75, 0.5), 0.3}}, kDomain, kVoxel);
  CHECK(isClosed(cut));
  CHECK_THAT(volumeOf(cut), WithinAbs(0.5 * ballVolume, 0.05 * ballVolume));

  // However fine the cells are, the sides of a cylinder can be counted.
  const Cylinder rod{Vec3d(1.0, 0.75, 0.25), Vec3d(1.0, 0.75, 0.75), 0.2};
  CHECK_THAT(volumeOf(triangulate(Shape{rod}, kDomain, 1e-11)),
             Catch::Matchers::WithinRel(0.02 * std::numbers::pi, 1e-3));

  const Shape box{Box{Vec3d(0.5, 0.25, 0.0), Vec3d(1.5, 1.25, 0.5)}};
  // The same out of a box elsewhere.
  const Vec3d away(-6.0, 3.0, -2.0);
  const TriangleMesh there = triangulate(Shape{Sphere{Vec3d(0.0, 0.75, 0.5) + away, 0.3}},
                                         openvdb::BBoxd(kDomain.min() + away, kDomain.max() + away), kVoxel);
  CHECK_THAT(volumeOf(there), Catch::Matchers::WithinRel(volumeOf(cut), 1e-4));
  const TriangleMesh bowl = triangulate(Shape{Difference{{box, Shape{ball}}}}, kDomain, 0.025);
  CHECK(isClosed(bowl));
  CHECK_THAT(volumeOf(bowl), WithinAbs(0.5 - 0.5 * ballVolume, 0.01));
  const TriangleMesh knob = triangulate(Shape{Union{{box, Shape{ball}}}}, kDomain, 0.025);
  CHECK(isClosed(knob));
  CHECK_THAT(volumeOf(knob), WithinAbs(0.5 + 0.5 * ballVolume, 0.01));
}
