#include "tools/output/ply.h"

#include "tests/scratch.h"
#include "tests/tools/output/sample_surface.h"
#include "tools/base/errors.h"
#include "tools/output/read_ply.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <limits>
#include <sstream>

using namespace fluidtex;

namespace {

template <typename T>
T valueAt(const std::string& bytes, std::size_t offset) {
  T value;
  REQUIRE(offset + sizeof(T) <= bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

}  // namespace

TEST_CASE(
    "PLY: has the properties of docs/reference/files.md in their order, and the bytes of every vertex and "
    "face",
    "[tools]") {
  const Scratch scratch;
  const texture::TexturedSurface surface = sampleSurface();
  tools::writePly(surface, scratch.path / "a.ply");
  const std::string bytes = readBytes(scratch.path / "a.ply");
  const std::size_t body = bytes.find("end_header\n") + 11;

  std::vector<std::string> names;
  std::istringstream header(bytes.substr(0, body));
  std::string word, type, name;
  std::size_t stride = 0;
  while (header >> word) {
    if (word != "property") continue;
    header >> type;
    if (type == "list") break;
    header >> name;
    names.push_back(name);
    stride += type == "uchar" ? 1 : 4;
  }
  CHECK(names == std::vector<std::string>{"x",     "y",    "z",       "nx",     "ny",     "nz",   "red",
                                          "green", "blue", "alpha",   "s",      "t",      "dx",   "dy",
                                          "dz",    "bx",   "by",      "bz",     "vx",     "vy",   "vz",
                                          "trust", "age",  "contact", "fade_s", "fade_t", "fade", "height"});
  REQUIRE(bytes.size() == body + 4 * stride + 4 * 13);

  // Vertex 1 of the sample: at (1, 0, 0), linear grey 0.5 with alpha 0.25, texel (3, 1) of 8 x 4.
  const std::size_t vertex = body + stride;
  CHECK(valueAt<float>(bytes, vertex) == 1.0f);
  CHECK(int(valueAt<std::uint8_t>(bytes, vertex + 24)) == 188);  // sRGB of linear 0.5
  CHECK(int(valueAt<std::uint8_t>(bytes, vertex + 27)) == 64);
  CHECK(valueAt<float>(bytes, vertex + 28) == Approx(3.5 / 8));
  CHECK(valueAt<float>(bytes, vertex + 32) == Approx(1.5 / 4));
  CHECK(int(valueAt<std::uint8_t>(bytes, vertex + stride - 17)) == 1);  // contact
  CHECK(valueAt<float>(bytes, vertex + stride - 16) ==
        Approx(1.5 / 8));  // the place that fades: texel (1, 2)
  CHECK(valueAt<float>(bytes, vertex + stride - 12) == Approx(2.5 / 4));
  CHECK(valueAt<float>(bytes, vertex + stride - 8) == 0.3f);
  CHECK(valueAt<float>(bytes, vertex + stride - 4) == 11.0f);  // height
  const std::size_t face = body + 4 * stride;
  CHECK(int(valueAt<std::uint8_t>(bytes, face)) == 3);
  CHECK(valueAt<std::int32_t>(bytes, face + 1) == 0);
  CHECK(valueAt<std::int32_t>(bytes, face + 5) == 2);
}

TEST_CASE("PLY: coordinates stay within 0 and 1 where a toroidal exemplar leads over its edge", "[tools]") {
  const Scratch scratch;
  texture::TexturedSurface surface = sampleSurface();  // of an exemplar of 8 x 4
  surface.coordinate = {{7.75f, 3.9f}, {7.25f, 0.0f}, {0.0f, 3.25f}, {7.5f, 3.5f}};
  tools::writePly(surface, scratch.path / "a.ply");
  const std::string bytes = readBytes(scratch.path / "a.ply");
  const std::size_t body = bytes.find("end_header\n") + 11, stride = (bytes.size() - body - 4 * 13) / 4;
  const float expected[4][2] = {
      {0.25f / 8, 0.4f / 4}, {7.75f / 8, 0.5f / 4}, {0.5f / 8, 3.75f / 4}, {0.0f, 0.0f}};
  for (std::size_t v = 0; v < 4; ++v)
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(valueAt<float>(bytes, body + v * stride + 28 + 4 * k) == Approx(expected[v][k]).margin(1e-6));
}

TEST_CASE("PLY: a frame without surface is a file without vertices", "[tools]") {
  const Scratch scratch;
  tools::writePly({}, scratch.path / "a.ply");
  CHECK(readBytes(scratch.path / "a.ply").find("element vertex 0\n") != std::string::npos);
}

TEST_CASE("PLY: a folder that is not there is an error that names the file", "[tools]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(tools::writePly({}, scratch.path / "no" / "a.ply"),
                    Catch::Contains("a.ply: cannot write"));
}

TEST_CASE("PLY: what was written is read back, to the file's own steps", "[tools]") {
  const Scratch scratch;
  const texture::TexturedSurface surface = sampleSurface();
  tools::writePly(surface, scratch.path / "a.ply");
  const texture::TexturedSurface back = tools::readPly(scratch.path / "a.ply", 8, 4);
  CHECK(back.positions == surface.positions);
  CHECK(back.normals == surface.normals);
  CHECK(back.orientation == surface.orientation);
  CHECK(back.triangles == surface.triangles);
  CHECK(back.previousPosition == surface.previousPosition);
  CHECK(back.velocity == surface.velocity);
  CHECK(back.trust == surface.trust);
  CHECK(back.age == surface.age);
  CHECK(back.contact == surface.contact);
  CHECK((back.exemplarWidth == 8 && back.exemplarHeight == 4));
  CHECK(back.maps == surface.maps);
  CHECK(back.fading.weight == surface.fading.weight);
  for (std::size_t v = 0; v < 4; ++v)
    if (surface.fading.weight[v] > 0.0f)
      CHECK((back.fading.coordinate[v] - surface.fading.coordinate[v]).length() < 1e-5f);
  for (std::size_t v = 0; v < 4; ++v) {
    CHECK(back.coordinate[v].x() == Approx(surface.coordinate[v].x()).margin(1e-5));
    CHECK(back.coordinate[v].y() == Approx(surface.coordinate[v].y()).margin(1e-5));
    for (int c = 0; c < 3; ++c) CHECK(back.color[v][c] == Approx(surface.color[v][c]).margin(0.01));
    CHECK(back.color[v][3] == Approx(surface.color[v][3]).margin(0.5 / 255));
  }
}

TEST_CASE("PLY: a file that is cut short, too long or another one is refused by name", "[tools]") {
  const Scratch scratch;
  const std::filesystem::path file = scratch.path / "a.ply", broken = scratch.path / "broken.ply";
  tools::writePly(sampleSurface(), file);
  const std::string bytes = readBytes(file);
  const auto refused = [&](const std::string& content) {
    std::ofstream(broken, std::ios::binary) << content;
    CHECK_THROWS_AS(tools::readPly(broken, 8, 4), tools::UsageError);
    CHECK_THROWS_WITH(tools::readPly(broken, 8, 4), Catch::Contains("broken.ply"));
  };
  for (std::size_t length = 0; length < bytes.size(); length += 7) refused(bytes.substr(0, length));
  refused(bytes + "x");
  std::string ascii = bytes;
  refused(ascii.replace(ascii.find("binary_little_endian"), 20, "ascii"));
  std::string corner = bytes;
  corner[corner.size() - 1] = 0x7f;  // of the last corner's number
  refused(corner);
  std::string without = bytes;
  refused(without.replace(without.find("float trust"), 11, "float truss"));
  CHECK_THROWS_AS(tools::readPly(scratch.path / "none.ply", 8, 4), tools::UsageError);
}

TEST_CASE("PLY: coordinates that are nowhere on the exemplar are refused", "[tools]") {
  const Scratch scratch;
  const std::filesystem::path broken = scratch.path / "broken.ply";
  tools::writePly(sampleSurface(), scratch.path / "a.ply");
  const std::string bytes = readBytes(scratch.path / "a.ply"), end = "end_header\n";
  const std::size_t s = bytes.find(end) + end.size() + 6 * sizeof(float) + 4;  // of the first vertex
  const auto write = [&](float value, int place) {
    std::string content = bytes;
    std::memcpy(&content[s + place * sizeof value], &value, sizeof value);
    std::ofstream(broken, std::ios::binary) << content;
  };
  for (const int place : {0, 1}) {
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), 1e30f, -0.1f}) {
      write(value, place);
      CHECK_THROWS_AS(tools::readPly(broken, 8, 4), tools::UsageError);
      CHECK_THROWS_WITH(tools::readPly(broken, 8, 4), Catch::Contains("not from 0 to 1"));
    }
    write(1.0f, place);
    CHECK_NOTHROW(tools::readPly(broken, 8, 4));
  }
}

TEST_CASE("PLY: properties that are not in the order and of the types that are read are refused", "[tools]") {
  const Scratch scratch;
  const std::filesystem::path broken = scratch.path / "broken.ply";
  tools::writePly(sampleSurface(), scratch.path / "a.ply");
  const std::string bytes = readBytes(scratch.path / "a.ply");
  const auto refused = [&](const std::string& before, const std::string& after, const char* words) {
    std::string content = bytes;
    REQUIRE(content.find(before) != content.npos);
    std::ofstream(broken, std::ios::binary) << content.replace(content.find(before), before.size(), after);
    INFO(after);
    CHECK_THROWS_AS(tools::readPly(broken, 8, 4), tools::UsageError);
    CHECK_THROWS_WITH(tools::readPly(broken, 8, 4), Catch::Contains(words));
  };
  refused("float y\n", "float q\n", "has no property y");
  refused("float y\nproperty float z\n", "float z\nproperty float y\n", "y that does not follow");
  refused("element face", "property float x\nelement face", "y that does not follow");  // read past the end
  refused("uchar alpha\n", "float alpha\n", "alpha that is no uchar");
  refused("float trust\n", "uchar trust\n", "trust that is no float");
  refused("float trust\n", "double trust\n", "neither float nor uchar");
  refused("float trust\n", std::string("float b\0\xff\n", 10), "name is no map's");
  refused("uchar contact\n", "uchar own\n", "own that is no float");
}
