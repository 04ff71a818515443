#include "sim/meshes/read_uv_mesh.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;
using openvdb::Vec2f;
using openvdb::Vec3f;

namespace {

// A square in the plane z = 0, seen from above counter-clockwise, and one of its corners again behind it.
const std::string kSquare = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 0.5\nvt 0 0.5\n";

UvMesh meshOf(const std::string& text, MeshPlace place = {}) {
  const Scratch folder;
  const std::filesystem::path file = folder.path / "m.obj";
  std::ofstream(file) << text;
  return readUvMesh({file, place});
}

// Where the mesh shows a place of the picture, by the triangle that has it.
Vec2f uvAt(const UvMesh& mesh, const Vec3f& x) {
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const Vec3f &a = mesh.positions[i], &b = mesh.positions[i + 1], &c = mesh.positions[i + 2];
    const Vec3f normal = (b - a).cross(c - a);
    const float square = normal.lengthSqr();
    const float v = (x - a).cross(c - a).dot(normal) / square, w = (b - a).cross(x - a).dot(normal) / square;
    if (v < -1e-4f || w < -1e-4f || v + w > 1.0001f) continue;
    return mesh.uv[i] * (1.0f - v - w) + mesh.uv[i + 1] * v + mesh.uv[i + 2] * w;
  }
  FAIL("no triangle is there");
  return {};
}

}  // namespace

TEST_CASE("uv mesh: corners have their places, polygons are cut, places lie where they are put") {
  const UvMesh mesh = meshOf(kSquare + "f 1/1 2/2 3/3 4/4\n", {.scale = 0.5, .translate = Vec3d(1, 0, 0)});
  REQUIRE(mesh.positions.size() == 6);
  REQUIRE(mesh.uv.size() == 6);
  CHECK((uvAt(mesh, {1.25f, 0.25f, 0.0f}) - Vec2f(0.25f, 0.125f)).length() < 1e-6f);
  CHECK((uvAt(mesh, {1.9f, 0.8f, 0.0f}) - Vec2f(0.9f, 0.4f)).length() < 1e-6f);
}

TEST_CASE("uv mesh: places may stand behind the faces, be counted backwards, and have a normal beside them") {
  const UvMesh ahead = meshOf("v 0 0 0\nv 2 0 0\nv 2 2 0\nf 1/1/7 2/2/7 3/3/7\nvt 0 0\nvt 1 0\nvt 1 0.5\n");
  CHECK((uvAt(ahead, {1.5f, 0.5f, 0.0f}) - Vec2f(0.75f, 0.125f)).length() < 1e-6f);
  const UvMesh back = meshOf(kSquare + "f -4/-4 -3/-3 -2/-2\n");
  CHECK((uvAt(back, {1.5f, 0.5f, 0.0f}) - Vec2f(0.75f, 0.125f)).length() < 1e-6f);
}

TEST_CASE("uv mesh: faces without places are left out, a triangle is moved onto the picture whole") {
  const UvMesh some = meshOf(kSquare + "f 1/1 2/2 3/3\nf 1 3 4\nf 1//1 3//1 4/4\n");
  CHECK(some.positions.size() == 3);
  const UvMesh far = meshOf("v 0 0 0\nv 2 0 0\nv 2 2 0\nvt 3.9 -2\nvt 4.1 -2\nvt 4.1 -1.5\nf 1/1 2/2 3/3\n");
  CHECK((far.uv[0] - Vec2f(-0.1f, 0.0f)).length() < 1e-6f);
  CHECK((far.uv[1] - Vec2f(0.1f, 0.0f)).length() < 1e-6f);
}

TEST_CASE("uv mesh: one that is inside out is turned round") {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n";
  const auto volume = [](const UvMesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
      sum += mesh.positions[i].dot(mesh.positions[i + 1].cross(mesh.positions[i + 2]));
    return sum / 6.0;
  };
  const UvMesh outward = meshOf(corners + "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\nf 3/1 1/2 4/3\n");
  const UvMesh inward = meshOf(corners + "f 1/1 2/3 3/2\nf 1/1 4/3 2/2\nf 2/1 4/3 3/2\nf 3/1 4/3 1/2\n");
  CHECK(volume(outward) == Approx(1.0 / 6.0));
  CHECK(volume(inward) == Approx(1.0 / 6.0));
  for (const float x : {0.2f, 0.4f})
    CHECK((uvAt(inward, {x, 0.3f, 0.0f}) - uvAt(outward, {x, 0.3f, 0.0f})).length() < 1e-6f);
}

TEST_CASE("uv mesh: what is wrong is said with its line") {
  const std::string triangle = "v 0 0 0\nv 2 0 0\nv 2 2 0\n";
  const std::pair<std::string, std::string> cases[] = {
      {"f 1 2 3\n", "m.obj: no face has texture coordinates; unwrap it"},
      {"vt 0 x\nf 1/1 2/1 3/1\n", "m.obj: line 4: 'x' is not a finite number"},
      {"vt 0 nan\nf 1/1 2/1 3/1\n", "m.obj: line 4: 'nan' is not a finite number"},
      {"vt\nf 1/1 2/1 3/1\n", "m.obj: line 4: a texture coordinate needs a number"},
      {"vt 0 0\nf 1/1 2/0 3/1\n", "m.obj: line 5: '2/0' names no texture coordinate"},
      {"vt 0 0\nf 1/1 2/-2 3/1\n", "m.obj: line 5: '2/-2' names no texture coordinate"},
      {"vt 0 0\nf 1/1 2/b 3/1\n", "m.obj: line 5: '2/b' names no texture coordinate"},
      {"vt 0 0\nf 1/1 2/9 3/1\n", "m.obj: face 1 names texture coordinate 9, but there are 1"},
  };
  for (const auto& [text, message] : cases) {
    INFO(text);
    CHECK_THROWS_WITH(meshOf(triangle + text), Contains(message));
    // Those who want no places read it.
    const Scratch folder;
    std::ofstream(folder.path / "m.obj") << triangle + text;
    CHECK(readSoup(folder.path / "m.obj").polygons.size() == 1);
  }
  SoupUv uv;
  const Scratch folder;
  std::ofstream(folder.path / "m.stl") << "solid\n";
  CHECK_THROWS_WITH(readSoup(folder.path / "m.stl", uv), Contains("are read of .obj alone"));
}
