#include "tools/formats/usda.h"

#include "tests/tools/formats/sample_mesh.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

namespace {

std::string usdaOf(const tools::ExportMesh& mesh, const tools::Appearance& appearance) {
  return written([&](std::ostream& out) { tools::writeUsda(mesh, appearance, out); });
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("usda: values stand at the frame's time code, coordinates at corners by index", "[tools]") {
  tools::Appearance appearance;
  appearance.picture = "exemplar.png";
  appearance.toroidal = true;
  const std::string text = usdaOf(sampleMesh(), appearance);
  CHECK(text.starts_with("#usda 1.0\n"));
  CHECK(holds(text, "upAxis = \"Z\""));
  CHECK(holds(text, "metersPerUnit = 1\n"));
  CHECK(holds(text, "startTimeCode = 7\n"));
  CHECK(holds(text, "timeCodesPerSecond = 24\n"));
  CHECK(holds(
      text,
      "point3f[] points.timeSamples = {\n            7: [(0, 0, 2), (1, 0, 2), (1, 3, 2), (0, 3, 2)],"));
  CHECK(holds(text, "vector3f[] velocities.timeSamples = {\n            7: [(1, 2, 3),"));
  CHECK(holds(text, "int[] faceVertexIndices.timeSamples = {\n            7: [0, 1, 2, 0, 2, 3],"));
  CHECK(holds(text, "float[] primvars:age.timeSamples = {\n            7: [0.5, 1.5, 2.5, 3.5],"));
  CHECK(holds(text, "texCoord2f[] primvars:st (\n            interpolation = \"faceVarying\""));
  // The origin is the lower left corner.
  CHECK(holds(text,
              "primvars:st.timeSamples = {\n            7: [(0.25, 0.875), (1.25, 0.875), (1.25, 0.25), "
              "(0.25, 0.25)],"));
  CHECK(holds(text, "primvars:st:indices.timeSamples = {\n            7: [0, 1, 2, 0, 2, 3],"));
  CHECK(holds(text, "color3f[] primvars:displayColor.timeSamples = {\n            7: [(1, 0, 0),"));
  CHECK(holds(text, "float3[] extent.timeSamples = {\n            7: [(0, 0, 2), (1, 3, 2)],"));
  CHECK(holds(text, "asset inputs:file = @../exemplar.png@"));
  CHECK(holds(text, "token inputs:wrapS = \"repeat\""));
  CHECK_FALSE(holds(text, "displayOpacity"));
}

TEST_CASE("usda: without a picture, or with joints that blend, there is no material", "[tools]") {
  tools::Appearance appearance;
  CHECK_FALSE(holds(usdaOf(sampleMesh(), appearance), "Material"));
  appearance.picture = "exemplar.png";
  tools::ExportMesh blended = samplePieces();
  blended.corner.push_back({"joint", 3, std::vector<float>(18, 0.0f)});
  const std::string text = usdaOf(blended, appearance);
  CHECK_FALSE(holds(text, "Material"));
  CHECK(holds(text, "float3[] primvars:joint (\n            interpolation = \"faceVarying\""));
  // Rows that are equal are there once.
  CHECK(holds(text,
              "primvars:st.timeSamples = {\n            7: [(0, 1), (1, 1), (1, 0), (0.5, 0.5), (0, 0)],"));
  CHECK(holds(text, "primvars:st:indices.timeSamples = {\n            7: [0, 1, 2, 0, 3, 4],"));
}

TEST_CASE("usda: the stage takes each frame from its file, and what there is from the fullest", "[tools]") {
  const std::string text = written([](std::ostream& out) { tools::writeUsdStage({3, 4, 6}, 4, 25.0, out); });
  CHECK(holds(text, "startTimeCode = 3\n"));
  CHECK(holds(text, "endTimeCode = 6\n"));
  CHECK(holds(text, "timeCodesPerSecond = 25\n"));
  CHECK(holds(text, "prepend references = @./usd/0004.usda@</liquid>"));
  CHECK(holds(text, "asset[] assetPaths = [@./usd/0003.usda@, @./usd/0004.usda@, @./usd/0006.usda@]"));
  CHECK(holds(text, "double2[] active = [(3, 0), (4, 1), (6, 2)]"));
  CHECK(holds(text, "double2[] times = [(3, 3), (4, 4), (6, 6)]"));
}
