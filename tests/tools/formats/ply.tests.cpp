#include "tools/formats/ply.h"

#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"

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
  tools::writePly(surface, {}, scratch.path / "a.ply");
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
  CHECK(names == std::vector<std::string>{
                     "x",      "y",       "z",       "nx",      "ny",      "nz",      "red",     "green",
                     "blue",   "alpha",   "s",       "t",       "dx",      "dy",      "dz",      "bx",
                     "by",     "bz",      "vx",      "vy",      "vz",      "trust",   "age",     "contact",
                     "fade_s", "fade_t",  "fade",    "sx",      "sy",      "sz",      "tx",      "ty",
                     "tz",     "fade_sx", "fade_sy", "fade_sz", "fade_tx", "fade_ty", "fade_tz", "height"});
  REQUIRE(bytes.size() == body + 4 * stride + 4 * 13);

  // Vertex 1 of the sample: at (1, 0, 0), linear grey 0.5 with alpha 0.25, texel (3, 1) of 8 x 4.
  const std::size_t vertex = body + stride;
  CHECK(valueAt<float>(bytes, vertex) == 1.0f);
  CHECK(int(valueAt<std::uint8_t>(bytes, vertex + 24)) == 188);  // sRGB of linear 0.5
  CHECK(int(valueAt<std::uint8_t>(bytes, vertex + 27)) == 64);
  CHECK(valueAt<float>(bytes, vertex + 28) == Approx(3.5 / 8));
  CHECK(valueAt<float>(bytes, vertex + 32) == Approx(1.5 / 4));
  CHECK(int(valueAt<std::uint8_t>(bytes, vertex + stride - 65)) == 1);  // contact
  CHECK(valueAt<float>(bytes, vertex + stride - 64) ==
        Approx(1.5 / 8));  // the place that fades: texel (1, 2)
  CHECK(valueAt<float>(bytes, vertex + stride - 60) == Approx(2.5 / 4));
  CHECK(valueAt<float>(bytes, vertex + stride - 56) == 0.3f);
  CHECK(valueAt<float>(bytes, vertex + stride - 4) == 11.0f);  // height
  // Gradients, of s over a width of 8 and of t over a height of 4: {1, 1, 2}, {3, 1, 5}; {7, 1, 2}, {1, 8,
  // 9}.
  const float gradients[12] = {0.125f, 0.125f, 0.25f, 0.75f, 0.25f, 1.25f,
                               0.875f, 0.125f, 0.25f, 0.25f, 2.0f,  2.25f};
  for (std::size_t k = 0; k < 12; ++k)
    CHECK(valueAt<float>(bytes, vertex + stride - 52 + 4 * k) == gradients[k]);
  const std::size_t face = body + 4 * stride;
  CHECK(int(valueAt<std::uint8_t>(bytes, face)) == 3);
  CHECK(valueAt<std::int32_t>(bytes, face + 1) == 0);
  CHECK(valueAt<std::int32_t>(bytes, face + 5) == 2);
}

TEST_CASE("PLY: triangles of several pieces follow behind the faces, as records of one size", "[tools]") {
  const Scratch scratch;
  const texture::TexturedSurface surface = sampleSurface();
  const texture::Joints joints = texture::findJoints(surface, false);
  REQUIRE(joints.joints.size() == 4);  // no two vertices' coordinates go on each other
  tools::writePly(surface, joints, scratch.path / "a.ply");
  const std::string bytes = readBytes(scratch.path / "a.ply");
  const std::size_t end = bytes.find("end_header\n");
  const std::string header = bytes.substr(0, end);
  std::string wanted = "element joint 4\nproperty int face\n";
  for (const char* prefix : {"", "fade_"})
    for (int label = 0; label < 3; ++label)
      for (int corner = 0; corner < 3; ++corner)
        for (const char* axis : {"s", "t"})
          wanted += "property float " + std::string(prefix) + axis + std::to_string(label) +
                    std::to_string(corner) + "\n";
  CHECK(header.substr(header.find("element joint")) == wanted);
  const std::size_t stride = (22 + 12 + 1) * 4 + 5, first = end + 11 + 4 * stride + 4 * 13;
  REQUIRE(bytes.size() == first + 4 * 148);
  for (std::size_t j = 0; j < 4; ++j) {
    const texture::Joint& joint = joints.joints[j];
    const std::size_t record = first + 148 * j;
    CHECK(valueAt<std::int32_t>(bytes, record) == std::int32_t(j));
    for (std::size_t label = 0; label < 3; ++label) {
      const auto v = surface.triangles[j][int(label)];
      // A label at its own corner is the vertex's s and t.
      const std::size_t own = record + 4 + 8 * (3 * label + label), vertex = end + 11 + v * stride;
      CHECK(valueAt<float>(bytes, own) == valueAt<float>(bytes, vertex + 28));
      CHECK(valueAt<float>(bytes, own + 4) == valueAt<float>(bytes, vertex + 32));
      CHECK(valueAt<float>(bytes, own + 72) == Approx(valueAt<float>(bytes, vertex + stride - 64)));
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t place = record + 4 + 8 * (3 * label + corner);
        CHECK(valueAt<float>(bytes, place) == Approx((joint.shown[label][corner].x() + 0.5f) / 8.0f));
        CHECK(valueAt<float>(bytes, place + 72 + 4) ==
              Approx((joint.former[label][corner].y() + 0.5f) / 4.0f));
      }
    }
  }
}

TEST_CASE("PLY: coordinates stay within 0 and 1 where a toroidal exemplar leads over its edge", "[tools]") {
  const Scratch scratch;
  texture::TexturedSurface surface = sampleSurface();  // of an exemplar of 8 x 4
  surface.coordinate = {{7.75f, 3.9f}, {7.25f, 0.0f}, {0.0f, 3.25f}, {7.5f, 3.5f}};
  tools::writePly(surface, {}, scratch.path / "a.ply");
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
  tools::writePly({}, {}, scratch.path / "a.ply");
  CHECK(readBytes(scratch.path / "a.ply").find("element vertex 0\n") != std::string::npos);
}

TEST_CASE("PLY: a folder that is not there is an error that names the file", "[tools]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(tools::writePly({}, {}, scratch.path / "no" / "a.ply"),
                    Catch::Contains("a.ply: cannot write"));
}
