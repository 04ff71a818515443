#include "tools/formats/usda.h"

#include "tests/tools/formats/sample_mesh.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using Catch::Contains;

namespace {

std::string usdaOf(const tools::ExportMesh& mesh, const tools::Appearance& appearance) {
  return written([&](std::ostream& out) { tools::writeUsda(mesh, appearance, out); });
}

void checkHolds(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) CHECK_THAT(text, Contains(part));
}

}  // namespace

TEST_CASE("usda: values stand at the frame's time code, coordinates at corners by index", "[tools]") {
  tools::Appearance appearance;
  appearance.picture = "exemplar.png";
  appearance.toroidal = true;
  const std::string text = usdaOf(sampleMesh(), appearance);
  CHECK(text.starts_with("#usda 1.0\n"));
  checkHolds(
      text, {"upAxis = \"Z\"", "metersPerUnit = 1\n", "startTimeCode = 7\n", "timeCodesPerSecond = 24\n",
             "point3f[] points.timeSamples = {\n            7: [(0, 0, 2), (1, 0, 2), (1, 3, 2), (0, 3, 2)],",
             "vector3f[] velocities.timeSamples = {\n            7: [(1, 2, 3),",
             "int[] faceVertexIndices.timeSamples = {\n            7: [0, 1, 2, 0, 2, 3],",
             "float[] primvars:age.timeSamples = {\n            7: [0.5, 1.5, 2.5, 3.5],",
             "texCoord2f[] primvars:st (\n            interpolation = \"faceVarying\"",
             // The origin is the lower left corner.
             "primvars:st.timeSamples = {\n            7: [(0.25, 0.875), (1.25, 0.875), (1.25, 0.25), "
             "(0.25, 0.25)],",
             "primvars:st:indices.timeSamples = {\n            7: [0, 1, 2, 0, 2, 3],",
             "color3f[] primvars:displayColor.timeSamples = {\n            7: [(1, 0, 0),",
             "float3[] extent.timeSamples = {\n            7: [(0, 0, 2), (1, 3, 2)],",
             "asset inputs:file = @../exemplar.png@", "token inputs:wrapS = \"repeat\""});
  CHECK_THAT(text, !Contains("displayOpacity"));
}

TEST_CASE("usda: without a picture, or with joints that blend, there is no material", "[tools]") {
  tools::Appearance appearance;
  CHECK_THAT(usdaOf(sampleMesh(), appearance), !Contains("Material"));
  appearance.picture = "exemplar.png";
  tools::ExportMesh blended = samplePieces();
  blended.corner.push_back({"joint", 3, std::vector<float>(18, 0.0f)});
  const std::string text = usdaOf(blended, appearance);
  CHECK_THAT(text, !Contains("Material"));
  checkHolds(text,
             {"float3[] primvars:joint (\n            interpolation = \"faceVarying\"",
              // Rows that are equal are there once.
              "primvars:st.timeSamples = {\n            7: [(0, 1), (1, 1), (1, 0), (0.5, 0.5), (0, 0)],",
              "primvars:st:indices.timeSamples = {\n            7: [0, 1, 2, 0, 3, 4],"});
}

TEST_CASE("usda: the stage takes each frame from its file, and what there is from the fullest", "[tools]") {
  const std::string text = written([](std::ostream& out) { tools::writeUsdStage({3, 4, 6}, 4, 25.0, out); });
  checkHolds(text,
             {"startTimeCode = 3\n", "endTimeCode = 6\n", "timeCodesPerSecond = 25\n",
              "prepend references = @./usd/0004.usda@</liquid>",
              "asset[] assetPaths = [@./usd/0003.usda@, @./usd/0004.usda@, @./usd/0006.usda@]",
              "double2[] active = [(3, 0), (4, 1), (6, 2)]", "double2[] times = [(3, 3), (4, 4), (6, 6)]"});
}

TEST_CASE("usda: the frame rate is not rounded", "[tools]") {
  tools::Appearance appearance;
  appearance.frameRate = 24000.0 / 1001.0;
  const std::string text = usdaOf(sampleMesh(), appearance);
  for (const char* key : {"timeCodesPerSecond = ", "framesPerSecond = "}) {
    REQUIRE(text.find(key) != std::string::npos);
    CHECK(std::stod(text.substr(text.find(key) + std::string(key).size())) == appearance.frameRate);
  }
}
