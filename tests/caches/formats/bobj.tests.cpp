#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

TEST_CASE("bobj: Blender's has normals, FLIP Fluids' has none, vectors have no triangles", "[caches]") {
  checkPyramid(geometryIn("a.bobj.gz", gzipped(bobj(true))));
  checkPyramid(geometryIn("a.bobj", bobj(true)));
  checkPyramid(geometryIn("a.bobj", bobj(false)));
  const Geometry vectors = geometryIn("velocity000001.bobj", bobj(false, false));
  CHECK(coordinatesOf(vectors) == kPyramid);
  CHECK(vectors.triangles.empty());
}

TEST_CASE("bobj: a frame without liquid", "[caches]") {
  for (const int counts : {1, 2, 3}) {
    const Geometry geometry = geometryIn("a.bobj", std::string(std::size_t(4 * counts), '\0'));
    CHECK(geometry.points.empty());
    CHECK(geometry.triangles.empty());
  }
}

TEST_CASE("bobj: a length that fits no kind is refused", "[caches]") {
  for (const std::size_t more : {1, 3, 4, 7, 8, 11, 12}) {
    CAPTURE(more);
    for (const bool normals : {false, true})
      CHECK_FALSE(refusalOf("a.bobj", bobj(normals) + std::string(more, '\0')).empty());
  }
  // Behind points alone, four zeros are a mesh of no triangles, and eight are normals of none.
  CHECK(refusalOf("a.bobj", bobj(false, false) + std::string(4, '\0')).empty());
  CHECK_THAT(refusalOf("a.bobj", bobj(false, false) + std::string(8, '\0')),
             Contains("5 points and 0 normals"));
  CHECK_THAT(refusalOf("a.bobj", bobj(false) + std::string(12, '\0')), Contains("12 bytes too many"));
}

TEST_CASE("bobj: counts that the file cannot hold", "[caches]") {
  std::string bytes;
  put(bytes, std::int32_t(-3));
  CHECK_THAT(refusalOf("a.bobj", bytes), Contains("-3 points"));
  bytes.clear();
  put(bytes, std::int32_t(2147483647));
  CHECK_THAT(refusalOf("a.bobj", bytes + std::string(100, '\0')),
             Contains("2147483647 points, and 100 bytes follow"));
}

TEST_CASE("bobj: the first corner that is no point is named", "[caches]") {
  std::string bytes = bobj(false);
  const std::size_t corners = bytes.size() - 6 * 12;
  bytes[corners + 12] = 5;
  CHECK_THAT(refusalOf("a.bobj", bytes),
             Contains("polygon 2 has point 5, counted from 0") && Contains("there are 5 points"));
  bytes[corners + 15] = char(0x80);
  CHECK_THAT(refusalOf("a.bobj", bytes), Contains("polygon 2 has point -2147483643"));
}
