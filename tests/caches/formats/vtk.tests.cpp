#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

std::string withText(std::string bytes, const std::string& before, const std::string& after) {
  const std::size_t at = bytes.find(before);
  REQUIRE(at != std::string::npos);
  return bytes.replace(at, before.size(), after);
}

}  // namespace

TEST_CASE(
    "vtk: text and binary, float and double, polygons and strips, both layouts of cells, both data sets",
    "[caches]") {
  for (int bits = 0; bits < 64; ++bits) {
    const VtkOptions options{bool(bits & 1), bool(bits & 2),  bool(bits & 4),
                             bool(bits & 8), bool(bits & 16), bool(bits & 32)};
    CAPTURE(bits);
    const Geometry geometry = geometryIn("a.vtk", vtk(options));
    checkPyramid(geometry);
    checkSpeeds(geometry, "velocity");
    CHECK(valuesOf(geometry, "heat C") == std::vector<double>{1, 2, 3, 4, 5});
    CHECK(valuesOf(geometry, "Id") == std::vector<double>{10, 11, 12, 13, 14});
    REQUIRE(geometry.attributes.contains("uv"));
    CHECK(geometry.attributes.at("uv").components == 2);
    CHECK(valuesOf(geometry, "uv") == std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
    CHECK(geometry.attributes.size() == 4);
  }
}

TEST_CASE("vtk: particles without cells, and an empty frame", "[caches]") {
  const std::string head = "# vtk DataFile Version 4.1\n\nBINARY\nDATASET UNSTRUCTURED_GRID\n";
  const Geometry particles =
      geometryIn("a.vtk", head + "POINTS 2 float\n" + bytesOf<float>({1, 2, 3, 4, 5, 6}, std::endian::big) +
                              "\nCELLS 2 4\n" + bytesOf<std::int32_t>({1, 0, 1, 1}, std::endian::big) +
                              "\nCELL_TYPES 2\n" + bytesOf<std::int32_t>({1, 1}, std::endian::big) +
                              "\nPOINT_DATA 2\nFIELD FieldData 1\nvelocity 3 2 double\n" +
                              bytesOf<double>({1, 0, 0, 0, 1, 0}, std::endian::big) + "\n");
  CHECK(coordinatesOf(particles) == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(valuesOf(particles, "velocity") == std::vector<double>{1, 0, 0, 0, 1, 0});
  CHECK(particles.triangles.empty());
  CHECK(geometryIn("a.vtk", head + "POINTS 0 float\nCELLS 0 0\nCELL_TYPES 0\nPOINT_DATA 0\n").points.empty());
  CHECK(geometryIn("a.vtk",
                   head + "POINTS 0 double\n\nCELLS 0 0\nOFFSETS vtktypeint64\n\nCONNECTIVITY vtktypeint64\n")
            .points.empty());
}

TEST_CASE("vtk: a field that announces more arrays than it has", "[caches]") {
  const std::string text =
      "# vtk DataFile Version 4.1\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n1 2 3\nCELLS 1 2\n1 "
      "0\n"
      "CELL_TYPES 1\n1\nPOINT_DATA 1\nFIELD FieldData 3\nvelocity 3 1 float\n4 5 6\n";
  for (const char* end : {"", "\n", "\n \n"})
    CHECK(valuesOf(geometryIn("a.vtk", text + end), "velocity") == std::vector<double>{4, 5, 6});
  CHECK_THROWS(geometryIn("a.vtk", text + "heat"));
}

TEST_CASE("vtk: lines that end as on Windows", "[caches]") {
  std::string text;
  for (const char letter : vtk()) text += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  checkPyramid(geometryIn("a.vtk", text));
}

TEST_CASE("vtk: what is wrong is said", "[caches]") {
  const std::string good = vtk();
  CHECK_THAT(refusalOf("a.vtk", "vtk"), Contains("does not begin with '# vtk DataFile Version'"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "ASCII", "ascii2")), Contains("expected ASCII or BINARY"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "POLYDATA", "STRUCTURED_POINTS")),
             Contains("POLYDATA and UNSTRUCTURED_GRID are read"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "POINTS 5", "POINTS -5")),
             Contains("whole number of 0 or more, and has '-5'"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "POINTS 5", "POINTS 4000000000000000000")),
             Contains("too short"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "5 float\n0", "5 float\nzero")),
             Contains("'zero', which is not a number"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "4 0 3 2 1", "4 0 3 5 1")), Contains("polygon 1 has point 5"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "4 0 3 2 1", "9 0 3 2 1")),
             Contains("cell 5 of 5 does not fit"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "POINT_DATA 5", "POINT_DATA 4")),
             Contains("4 rows for 5 points"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "Id 1 5 int", "Id 1 4 int")), Contains("'Id' has 4 values"));
  CHECK_THAT(refusalOf("a.vtk", withText(good, "VECTORS", "SPEEDS")), Contains("no part of a VTK file"));
  CHECK_THAT(refusalOf("a.vtk", withText(vtk({false, false, true}), "OFFSETS vtktypeint64\n0 4 7",
                                         "OFFSETS vtktypeint64\n0 4 3")),
             Contains("takes corners 4 to 3"));
}
