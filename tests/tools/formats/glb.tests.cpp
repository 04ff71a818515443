#include "tools/formats/glb.h"

#include "tests/tools/formats/sample_mesh.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

using namespace fluidtex;
using Json = nlohmann::json;

namespace {

std::string glbOf(const tools::ExportMesh& mesh, const tools::Appearance& appearance) {
  return written([&](std::ostream& out) { tools::writeGlb(mesh, appearance, out); });
}

std::uint32_t wordAt(const std::string& bytes, std::size_t offset) {
  std::uint32_t word = 0;
  REQUIRE(offset + sizeof word <= bytes.size());
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

// A file taken apart by the specification's section 4, every length looked at.
struct Glb {
  Json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 4) == "glTF");
    CHECK(wordAt(bytes, 4) == 2);
    CHECK(wordAt(bytes, 8) == bytes.size());
    std::size_t at = 12;
    for (int chunk = 0; at < bytes.size(); ++chunk) {
      const std::size_t length = wordAt(bytes, at);
      CHECK(length % 4 == 0);
      CHECK(bytes.substr(at + 4, 4) == (chunk == 0 ? std::string("JSON") : std::string("BIN\0", 4)));
      REQUIRE(at + 8 + length <= bytes.size());
      (chunk == 0 ? text : binary) = bytes.substr(at + 8, length);
      at += 8 + length;
    }
    CHECK(at == bytes.size());
    json = Json::parse(text);
  }

  // The values of an accessor, which must lie within its view and the buffer.
  std::vector<double> values(int number) const {
    const Json &accessor = json["accessors"][number],
               &view = json["bufferViews"][int(accessor["bufferView"])];
    const std::map<std::string, std::size_t> counts{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const std::size_t count = std::size_t(accessor["count"]) * counts.at(accessor["type"]),
                      offset = view["byteOffset"];
    const int type = accessor["componentType"];
    const std::size_t size = type == 5123 ? 2 : 4;
    CHECK(offset % 4 == 0);
    CHECK(std::size_t(view["byteLength"]) == count * size);
    REQUIRE(offset + count * size <= binary.size());
    std::vector<double> result;
    for (std::size_t i = 0; i < count; ++i) {
      const char* from = binary.data() + offset + i * size;
      if (type == 5126) {
        float value;
        std::memcpy(&value, from, sizeof value);
        result.push_back(value);
      } else if (type == 5125) {
        result.push_back(wordAt(binary, offset + i * size));
      } else {
        std::uint16_t value;
        std::memcpy(&value, from, sizeof value);
        result.push_back(value / 65535.0);
      }
    }
    return result;
  }
  std::vector<double> attribute(const std::string& name) const {
    REQUIRE(attributes().contains(name));
    return values(attributes()[name]);
  }
  const Json& attributes() const { return json["meshes"][0]["primitives"][0]["attributes"]; }
  std::string text;
};

const tools::Appearance kPictured{"dam & break", 24.0, "exemplar.png", true, false, 0.5, 0.04};

}  // namespace

TEST_CASE("glb: lengths, accessors and ranges are those of the mesh", "[tools]") {
  const Glb glb(glbOf(sampleMesh(), kPictured));
  CHECK(glb.json["buffers"][0]["byteLength"] == glb.binary.size());
  const Json& position = glb.json["accessors"][int(glb.attributes()["POSITION"])];
  CHECK(position["min"] == Json::array({0.0, 0.0, 2.0}));
  CHECK(position["max"] == Json::array({1.0, 3.0, 2.0}));
  CHECK(glb.attribute("POSITION") == std::vector<double>{0, 0, 2, 1, 0, 2, 1, 3, 2, 0, 3, 2});
  CHECK(glb.attribute("_VELOCITY") == std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  CHECK(glb.attribute("_AGE") == std::vector<double>{0.5, 1.5, 2.5, 3.5});
  // Of the file, as of the picture, the origin is top left.
  CHECK(glb.attribute("TEXCOORD_0") == std::vector<double>{0.25, 0.125, 1.25, 0.125, 1.25, 0.75, 0.25, 0.75});
  CHECK(glb.attribute("TEXCOORD_1") == std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1});
  CHECK(glb.values(glb.json["meshes"][0]["primitives"][0]["indices"]) ==
        std::vector<double>{0, 1, 2, 0, 2, 3});
  CHECK(glb.json["scenes"][0]["extras"]["frame"] == 7);
  // Every byte is in one view.
  std::size_t covered = 0;
  for (const Json& view : glb.json["bufferViews"]) covered += std::size_t(view["byteLength"]);
  CHECK(covered == glb.binary.size());
}

TEST_CASE("glb: the node turns Z to Y", "[tools]") {
  const Glb glb(glbOf(sampleMesh(), kPictured));
  const Json q = glb.json["nodes"][0]["rotation"];
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  CHECK(x * x + y * y + z * z + w * w == Approx(1.0));
  // The images of the axes y and z by the quaternion's matrix.
  CHECK(2 * (y * z - x * w) == Approx(1.0));   // z becomes y
  CHECK(2 * (y * z + x * w) == Approx(-1.0));  // y becomes -z
  CHECK(1 - 2 * (y * y + z * z) == Approx(1.0));
}

TEST_CASE("glb: colours multiply no picture: they are COLOR_0 only where the material has none", "[tools]") {
  const Glb pictured(glbOf(sampleMesh(), kPictured));
  CHECK_FALSE(pictured.attributes().contains("COLOR_0"));
  CHECK(pictured.attribute("_COLOR")[0] == 1.0);
  CHECK(pictured.attribute("_COLOR")[12] == Approx(0.5).margin(1e-5));  // linear
  CHECK(pictured.json["images"][0]["uri"] == "../exemplar.png");
  CHECK(pictured.json["samplers"][0]["wrapS"] == 10497);
  const Json& coat = pictured.json["materials"][0]["extensions"]["KHR_materials_clearcoat"];
  CHECK(coat["clearcoatFactor"] == 0.5);
  CHECK(double(coat["clearcoatRoughnessFactor"]) == Approx(0.2));

  tools::Appearance plain = kPictured;
  plain.picture.clear();
  const Glb colored(glbOf(sampleMesh(), plain));
  CHECK(colored.attributes().contains("COLOR_0"));
  CHECK_FALSE(colored.json.contains("images"));

  tools::ExportMesh blended = samplePieces();
  blended.corner.push_back({"joint", 3, std::vector<float>(18, 0.0f)});
  const Glb joints(glbOf(blended, kPictured));
  CHECK(joints.attributes().contains("COLOR_0"));
  CHECK(joints.attributes().contains("_JOINT"));
  CHECK(joints.attribute("TEXCOORD_0").size() == 10);  // a vertex was split
}

TEST_CASE("glb: a frame without surface is a file without a mesh", "[tools]") {
  const Glb glb(glbOf({}, kPictured));
  CHECK_FALSE(glb.json.contains("meshes"));
  CHECK_FALSE(glb.json.contains("buffers"));
  CHECK(glb.binary.empty());
}

TEST_CASE("glb: columns whose names differ in capitals alone stay apart", "[tools]") {
  tools::ExportMesh mesh = sampleMesh();
  mesh.vertex.push_back({"Age", 1, {9, 9, 9, 9}});
  mesh.vertex.push_back({"AGE", 1, {7, 7, 7, 7}});
  const Glb glb(glbOf(mesh, kPictured));
  CHECK(glb.attribute("_AGE")[0] == 0.5);
  CHECK(glb.attribute("_Age")[0] == 9.0);
  CHECK(glb.attribute("_AGE_")[0] == 7.0);
}
