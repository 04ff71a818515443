#include "tools/formats/obj.h"

#include "tests/tools/formats/sample_mesh.h"

#include <catch2/catch.hpp>

#include <sstream>

using namespace fluidtex;

namespace {

std::string objOf(const tools::ExportMesh& mesh) {
  return written([&](std::ostream& out) { tools::writeObj(mesh, {}, out); });
}

std::vector<std::string> linesThatBegin(const std::string& text, const std::string& with) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(with)) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("obj: Y is up, the origin of coordinates below, colours are sRGB", "[tools]") {
  const std::string text = objOf(sampleMesh());
  const std::vector<std::string> v = linesThatBegin(text, "v ");
  REQUIRE(v.size() == 4);
  CHECK(v[0] == "v 0 2 -0 1 0 0");
  CHECK(v[2] == "v 1 2 -3 0 0 1");
  CHECK(v[3] == "v 0 2 -3 0.7354 0.7354 0.7354");  // linear 0.5
  CHECK(linesThatBegin(text, "vn ")[0] == "vn 0 1 -0");
  CHECK(linesThatBegin(text, "vt ")[1] == "vt 1.25 0.875");
  CHECK(linesThatBegin(text, "f ") == std::vector<std::string>{"f 1/1/1 2/2/2 3/3/3", "f 1/1/1 3/3/3 4/4/4"});
  CHECK(linesThatBegin(text, "mtllib ") == std::vector<std::string>{"mtllib surface.mtl"});
}

TEST_CASE("obj: without UV sets faces have none", "[tools]") {
  tools::ExportMesh mesh = sampleMesh();
  mesh.vertex.clear();
  const std::string text = objOf(mesh);
  CHECK(linesThatBegin(text, "vt ").empty());
  CHECK(linesThatBegin(text, "f ")[1] == "f 1//1 3//3 4//4");
}

TEST_CASE("obj: the material names the picture by a way that holds when the folder is moved", "[tools]") {
  tools::Appearance appearance;
  appearance.picture = "exemplar.png";
  appearance.toroidal = true;
  CHECK(linesThatBegin(tools::mtlOf(appearance), "map_") ==
        std::vector<std::string>{"map_Kd ../exemplar.png"});
  appearance.toroidal = false;
  appearance.seeThrough = true;
  CHECK(linesThatBegin(tools::mtlOf(appearance), "map_") ==
        std::vector<std::string>{"map_Kd -clamp on ../exemplar.png", "map_d -clamp on ../exemplar.png"});
  appearance.picture.clear();
  CHECK(linesThatBegin(tools::mtlOf(appearance), "map_").empty());
}
