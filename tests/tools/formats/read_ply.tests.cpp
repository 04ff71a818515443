#include "tools/formats/read_ply.h"

#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"
#include "tools/base/errors.h"
#include "tools/formats/ply.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <fstream>
#include <limits>

using namespace fluidtex;
using texture::Vec3f;

TEST_CASE("read PLY: what was written is read back, to the file's own steps", "[tools]") {
  const Scratch scratch;
  const texture::TexturedSurface surface = sampleSurface();
  // Joints are passed over.
  const bool joined = GENERATE(false, true);
  tools::writePly(surface, joined ? texture::findJoints(surface, false) : texture::Joints{},
                  scratch.path / "a.ply");
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
  CHECK_FALSE(tools::lacksGradients(back));
  for (std::size_t v = 0; v < 4; ++v)
    if (surface.fading.weight[v] > 0.0f)
      CHECK((back.fading.coordinate[v] - surface.fading.coordinate[v]).length() < 1e-5f);
  for (std::size_t v = 0; v < 4; ++v) {
    const auto same = [](const Vec3f& a, const Vec3f& b) { return (a - b).length() < 1e-5f; };
    CHECK(
        (same(back.gradient[v].s, surface.gradient[v].s) && same(back.gradient[v].t, surface.gradient[v].t)));
    if (surface.fading.weight[v] > 0.0f) {
      CHECK(same(back.fading.gradient[v].s, surface.fading.gradient[v].s));
      CHECK(same(back.fading.gradient[v].t, surface.fading.gradient[v].t));
    }
    CHECK(back.coordinate[v].x() == Approx(surface.coordinate[v].x()).margin(1e-5));
    CHECK(back.coordinate[v].y() == Approx(surface.coordinate[v].y()).margin(1e-5));
    for (int c = 0; c < 3; ++c) CHECK(back.color[v][c] == Approx(surface.color[v][c]).margin(0.01));
    CHECK(back.color[v][3] == Approx(surface.color[v][3]).margin(0.5 / 255));
  }
}

TEST_CASE("read PLY: a file of a version without gradients and joints", "[tools]") {
  const Scratch scratch;
  const texture::TexturedSurface surface = sampleSurface();
  tools::writePly(surface, {}, scratch.path / "a.ply");
  // As it was before: without twelve floats a vertex, and without the last element.
  std::string bytes = readBytes(scratch.path / "a.ply");
  const std::size_t body = bytes.find("end_header\n") + 11, stride = (22 + 12 + 1) * 4 + 5;
  std::string header = bytes.substr(0, body), rest;
  for (std::size_t v = 0; v < 4; ++v) {
    rest += bytes.substr(body + v * stride, stride - 52);
    rest += bytes.substr(body + (v + 1) * stride - 4, 4);  // the further map
  }
  rest += bytes.substr(body + 4 * stride);
  header.erase(header.find("element joint"), header.find("end_header") - header.find("element joint"));
  const std::size_t gradients = header.find("property float sx"), map = header.find("property float height");
  header.erase(gradients, map - gradients);
  std::ofstream(scratch.path / "old.ply", std::ios::binary) << header << rest;
  const texture::TexturedSurface back = tools::readPly(scratch.path / "old.ply", 8, 4);
  CHECK(back.triangles == surface.triangles);
  CHECK(back.maps == surface.maps);
  CHECK(back.fading.weight == surface.fading.weight);
  CHECK(tools::lacksGradients(back));
}

TEST_CASE("read PLY: a file that is cut short, too long or another one is refused by name", "[tools]") {
  const Scratch scratch;
  const std::filesystem::path file = scratch.path / "a.ply", broken = scratch.path / "broken.ply";
  tools::writePly(sampleSurface(), texture::findJoints(sampleSurface(), false), file);
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
  corner[corner.size() - 4 * 148 - 1] = 0x7f;  // of the last corner's number
  refused(corner);
  std::string without = bytes;
  refused(without.replace(without.find("float trust"), 11, "float truss"));
  CHECK_THROWS_AS(tools::readPly(scratch.path / "none.ply", 8, 4), tools::UsageError);
}

TEST_CASE("read PLY: coordinates that are nowhere on the exemplar are refused", "[tools]") {
  const Scratch scratch;
  const std::filesystem::path broken = scratch.path / "broken.ply";
  tools::writePly(sampleSurface(), {}, scratch.path / "a.ply");
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

TEST_CASE("read PLY: properties that are not in the order and of the types that are read are refused",
          "[tools]") {
  const Scratch scratch;
  const std::filesystem::path broken = scratch.path / "broken.ply";
  tools::writePly(sampleSurface(), {}, scratch.path / "a.ply");
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

TEST_CASE("read PLY: what fuzzing begins with is read", "[tools]") {
  // Else every input is refused by its first lines.
  for (const char* seed : {"small.ply", "joints.ply"}) {
    CAPTURE(seed);
    CHECK(!tools::readPly(std::string(FLUIDTEX_SOURCE "/tests/fuzz/corpus/ply/") + seed, 64, 64)
               .coordinate.empty());
  }
}
