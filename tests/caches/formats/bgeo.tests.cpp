#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

void checkBgeo(const BgeoOptions& options) {
  const Geometry geometry = geometryIn("a.bgeo", bgeo(options));
  checkPyramid(geometry);
  checkSpeeds(geometry, "v");
  CHECK(valuesOf(geometry, "id") == std::vector<double>{100, 101, 102, 103, 104});
  CHECK(geometry.attributes.size() == 2);
}

}  // namespace

TEST_CASE("bgeo: polygons, one by one or in a run, with attributes at vertices, and texts", "[caches]") {
  for (const bool asRun : {false, true})
    for (const bool withVertexAttribute : {false, true})
      for (const bool withText : {false, true})
        for (const int particles : {0, 3}) checkBgeo({asRun, withVertexAttribute, withText, particles});
}

TEST_CASE("bgeo: corners of four bytes where there are more than 65535 points", "[caches]") {
  for (const std::int32_t points : {65535, 65536}) {
    const Geometry geometry = geometryIn("a.bgeo", bgeo({true, true, false, 0, points}));
    CHECK(geometry.points.size() == std::size_t(points));
    CHECK(geometry.triangles.size() == 6);
    CHECK(volumeOf(geometry) == Approx(kPyramidVolume));
  }
}

TEST_CASE("bgeo: packed by gzip as Partio does, and under the ending that Houdini has for it", "[caches]") {
  checkPyramid(geometryIn("ParticleData_Fluid_12.bgeo", gzipped(bgeo())));
  checkPyramid(geometryIn("a.bgeo.gz", gzipped(bgeo())));
  checkPyramid(geometryIn("a.bhclassic", bgeo()));
}

TEST_CASE("bgeo: particles as Partio writes them, without primitives", "[caches]") {
  std::string bytes = "BgeoV";
  for (const std::int32_t n : {5, 2, 0, 0, 0, 1, 0, 0, 0}) put(bytes, n, std::endian::big);
  putName(bytes, "velocity");
  put(bytes, std::uint16_t(3), std::endian::big);
  put(bytes, std::int32_t(5), std::endian::big);
  bytes += bytesOf<float>({0, 0, 0, 1, 2, 3, 1, 4, 5, 6, -1, -2, -3, 1, -4, -5, -6}, std::endian::big) +
           '\0' + '\xff';
  const Geometry geometry = geometryIn("a.bgeo", gzipped(bytes));
  CHECK(coordinatesOf(geometry) == std::vector<double>{1, 2, 3, -1, -2, -3});
  CHECK(valuesOf(geometry, "velocity") == std::vector<double>{4, 5, 6, -4, -5, -6});
  CHECK(geometry.triangles.empty());
}

TEST_CASE("bgeo: an empty frame, and an open polygon, which is a line", "[caches]") {
  std::string bytes = "BgeoV";
  for (const std::int32_t n : {5, 0, 0, 0, 0, 0, 0, 0, 0}) put(bytes, n, std::endian::big);
  CHECK(geometryIn("a.bgeo", bytes).points.empty());

  bytes = bgeo();
  bytes[bytes.find('<')] = ':';
  CHECK(geometryIn("a.bgeo", bytes).triangles.size() == 4);
}

TEST_CASE("bgeo: what is not read is refused with the way to what is", "[caches]") {
  CHECK_THAT(refusalOf("a.bgeo", "\x7fNSJb and more"), Contains("Houdini 12") && Contains(".bhclassic"));
  CHECK_THAT(refusalOf("a.bgeo", "Bgeo"), Contains("ends too early"));
  CHECK_THAT(refusalOf("a.bgeo", "Bhclassic"), Contains("begins with 'BgeoV'"));
  std::string bytes = bgeo();
  bytes[12] = '\x7f';  // of the number of points
  CHECK_THAT(refusalOf("a.bgeo", bytes), Contains("for which it is too short"));
  bytes = bgeo();
  bytes[9] = '\x80';
  CHECK_THAT(refusalOf("a.bgeo", bytes), Contains("counts are 0 or more"));
  bytes = bgeo({false});
  bytes[bytes.find('<') - 5] = 2;  // of the kind of the first primitive
  CHECK_THAT(refusalOf("a.bgeo", bytes), Contains("primitive 1 is of kind 2"));
}
