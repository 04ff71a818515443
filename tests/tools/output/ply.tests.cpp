#include "tools/output/ply.h"

#include "tests/scratch.h"
#include "tests/tools/output/sample_surface.h"

#include <catch2/catch.hpp>

#include <cstring>
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
