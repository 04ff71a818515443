// Damaged files: whatever a file of a mesh or of heights holds, it is read or refused with a sentence.
#include "sim/meshes/read_uv_mesh.h"
#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/read_heights.h"
#include "sim/shapes/shape_distance.h"
#include "tests/mutated.h"
#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <cstring>

using namespace fluidtex::sim;

namespace {

// What readers of these formats stumble over.
const std::vector<std::string> kWords{
    "-1", "0",  "4294967295",           "4000000000",        "1e308", "nan", "-0", "65535", "2147483648",
    " ",  "\n", std::string(4, '\xFF'), std::string(4, '\0')};

std::string binaryPly() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty "
      "float "
      "z\nproperty uchar red\nelement face 4\nproperty list uint ushort vertex_indices\nelement tristrips "
      "1\nproperty "
      "list int int vertex_indices\nend_header\n";
  const float x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& p : x) {
    append(bytes, p[0]);
    append(bytes, double(p[1]));
    append(bytes, p[2]);
    append(bytes, std::uint8_t(9));
  }
  for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    append(bytes, std::uint32_t(3));
    for (const int v : f) append(bytes, std::uint16_t(v));
  }
  append(bytes, std::int32_t(0));
  return bytes;
}

std::string textPly() {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty short y\nproperty float "
         "z\nelement face "
         "4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 "
         "3\n3 0 3 "
         "2\n3 1 2 3\n";
}

std::string binaryStl() {
  std::string bytes(80, ' ');
  append(bytes, std::uint32_t(4));
  const float x[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    append(bytes, std::array<float, 3>{});
    for (const int v : f) append(bytes, x[v]);
    append(bytes, std::uint16_t(0));
  }
  return bytes;
}

std::string textStl() {
  std::string text = "solid a\n";
  const std::string x[4] = {"0 0 0\n", "1 0 0\n", "0 1 0\n", "0 0 1\n"};
  for (const auto& f : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : f) text += "vertex " + x[v];
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid a\n";
}

std::string nestedObj() {
  std::string faces = kBoxFaces;
  for (const char c : kBoxFaces)
    faces += c >= '1' && c <= '8' ? std::to_string(c - '0' + 8) : std::string(1, c);
  return boxObj(Vec3d(0.0), Vec3d(1.0), "") + boxObj(Vec3d(0.2), Vec3d(0.8), "") + faces;
}

// An image in 16 bits, and one in floats with a number for no data.
std::string greyTiff() {
  std::string pixels;
  for (int n = 0; n < 64; ++n) append(pixels, std::uint16_t(n * 1000));
  return tiffBytes(8, 8, 16, 1, pixels, {{274, 3, 3}, {42113, 2, 0, "0"}});
}

std::string floatTiff() {
  std::string pixels;
  for (int n = 0; n < 64; ++n) append(pixels, n % 7 == 0 ? -3.4e38f : 0.01f * float(n));
  return tiffBytes(8, 8, 32, 1, pixels, {{339, 3, 3}, {42113, 2, 0, "-3.4028234663852886e+38"}});
}

std::string pgm() {
  return "P5 8 8 65535\n" + std::string(128, '\x21');
}

// How many of `count` mutated files are read; all others throw Fault. Adds the seconds of the longest.
template <class Fault, class Read>
int readable(const std::string& name, const std::string& bytes, int count, double& longest,
             const Read& read) {
  int good = 0;
  for (int n = 0; n < count; ++n) {
    const WrittenFile file(name, mutated(bytes, std::uint64_t(n), kWords));
    CAPTURE(name, n);
    const auto start = std::chrono::steady_clock::now();
    try {
      read(file.path, n);
      ++good;
    } catch (const Fault& fault) {
      const std::string sentence = fault.what();
      REQUIRE(sentence.starts_with(file.path.string() + ": "));
      REQUIRE(sentence.size() < file.path.string().size() + 400);
      REQUIRE(sentence.find('\n') == std::string::npos);
    }
    longest =
        std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return good;
}

// Of those that are read, one in so many is put on a grid, which takes longer.
constexpr int kOnGrid = 8;

// `count` of each kind of file.
void readMutatedMeshes(int count) {
  double longest = 0.0;
  int good = 0;
  const std::pair<std::string, std::string> files[] = {{"a.obj", nestedObj()}, {"b.obj", prismObj()},
                                                       {"a.ply", textPly()},   {"b.ply", binaryPly()},
                                                       {"a.stl", textStl()},   {"b.stl", binaryStl()}};
  for (const auto& [name, bytes] : files)
    good += readable<MeshError>(name, bytes, count, longest, [](const std::filesystem::path& file, int n) {
      const TriangleMesh mesh = readMesh(MeshShape{file});
      if (n % kOnGrid != 0) return;
      const ShapeDistance distance(mesh, 0.1, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)));
      REQUIRE(std::isfinite(distance(Vec3d(0.4))));
    });
  CHECK(good > count / 6);
  const std::string places =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1.5\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\n"
      "f 2/-3/1 3/-2/1 4/3/1\nf 3 1/2 4\nf 1/1 2/2 3/3 4/1\n";
  CHECK(readable<MeshError>("uv.obj", places, count, longest, [](const std::filesystem::path& file, int) {
          const UvMesh mesh = readUvMesh({file});
          REQUIRE(mesh.uv.size() == mesh.positions.size());
          for (const openvdb::Vec2f& place : mesh.uv)
            REQUIRE((std::isfinite(place[0]) && std::isfinite(place[1])));
        }) > count / 12);
  CHECK(longest < 5.0);
}

void readMutatedHeights(int count) {
  double longest = 0.0;
  int good = 0;
  const std::pair<std::string, std::string> files[] = {
      {"a.tif", greyTiff()}, {"b.tif", floatTiff()}, {"c.pgm", pgm()}, {"d.sgi", sgiBytes()}};
  for (const auto& [name, bytes] : files)
    good += readable<HeightError>(name, bytes, count, longest, [](const std::filesystem::path& file, int n) {
      readHeights(file);
      if (n % kOnGrid != 0) return;
      const ShapeDistance ground(Shape{HeightField{file, 0.1}}, 0.1, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)));
      REQUIRE(std::isfinite(ground(Vec3d(0.4))));
    });
  CHECK(good > count / 6);
  CHECK(longest < 5.0);
}

}  // namespace

TEST_CASE("mutated files: a mesh is read or refused, at once", "[sim]") {
  readMutatedMeshes(500);
}

TEST_CASE("mutated files: a field of heights is read or refused, at once", "[sim]") {
  readMutatedHeights(200);
}

TEST_CASE("mutated files: many of them", "[sim][long]") {
  readMutatedMeshes(10000);
  readMutatedHeights(10000);
}
