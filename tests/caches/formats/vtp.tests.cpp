#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

std::vector<VtpOptions> allOptions() {
  std::vector<VtpOptions> all;
  for (const auto format :
       {VtpOptions::ascii, VtpOptions::inlined, VtpOptions::appendedRaw, VtpOptions::appendedBase64})
    for (int bits = 0; bits < 16; ++bits)
      all.push_back({format, bool(bits & 1), bool(bits & 2), bool(bits & 4), bool(bits & 8)});
  return all;
}

std::string withText(std::string bytes, const std::string& before, const std::string& after) {
  const std::size_t at = bytes.find(before);
  REQUIRE(at != std::string::npos);
  return bytes.replace(at, before.size(), after);
}

}  // namespace

TEST_CASE("vtp: text, base64 and raw, packed or not, lengths of both sizes, both orders of bytes",
          "[caches]") {
  for (VtpOptions options : allOptions()) {
    for (const std::size_t blockSize : {7, 32, 60, 1000}) {
      CAPTURE(options.format, options.packed, options.longHeader, options.bigEndian, blockSize);
      options.blockSize = blockSize;
      const Geometry geometry = geometryIn("a.vtp", vtp(options));
      checkPyramid(geometry);
      checkSpeeds(geometry, "velocity");
      CHECK(valuesOf(geometry, "id") == std::vector<double>{9, 8, 7, 6, 5});
      CHECK(geometry.attributes.size() == 2);
      if (!options.packed) break;
    }
  }
}

TEST_CASE("vtp: pieces are one behind the other", "[caches]") {
  VtpOptions options;
  options.inTwoPieces = true;
  const Geometry geometry = geometryIn("a.vtp", vtp(options));
  CHECK(geometry.points.size() == 10);
  CHECK(volumeOf(geometry) == Approx(kPyramidVolume));
  for (std::size_t n = 0; n < geometry.triangles.size(); ++n)
    CHECK(geometry.triangles[n][0] / 5 == (n < 3 ? 0 : 1));
  std::vector<double> twice = kPyramidSpeeds;
  twice.insert(twice.end(), kPyramidSpeeds.begin(), kPyramidSpeeds.end());
  CHECK(valuesOf(geometry, "velocity") == twice);
}

TEST_CASE("vtp: an empty frame", "[caches]") {
  const std::string begin = "<VTKFile type=\"PolyData\"><PolyData>", end = "</PolyData></VTKFile>";
  CHECK(geometryIn("a.vtp", begin + end).points.empty());
  const Geometry empty = geometryIn(
      "a.vtp", begin +
                   "<Piece NumberOfPoints=\"0\" NumberOfPolys=\"0\"><Points><DataArray type=\"Float32\" "
                   "Name=\"Points\" "
                   "NumberOfComponents=\"3\" format=\"binary\">AAAAAA==</DataArray></Points></Piece>" +
                   end);
  CHECK(empty.points.empty());
}

TEST_CASE("vtp: what is wrong is said", "[caches]") {
  const std::string good = vtp();
  CHECK_THAT(refusalOf("a.vtp", "hello"), Contains("is not XML as VTK writes it"));
  CHECK_THAT(refusalOf("a.vtp", "<a/>"), Contains("no element VTKFile"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "PolyData\"", "ImageData\"")),
             Contains("type 'ImageData'; PolyData is read"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "LittleEndian", "Middle")), Contains("byte_order='Middle'"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "LittleEndian\"",
                                         "LittleEndian\" compressor=\"vtkLZ4DataCompressor\"")),
             Contains("packed by 'vtkLZ4DataCompressor'; write it with zlib"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "NumberOfPoints=\"5\"", "NumberOfPoints=\"6\"")),
             Contains("15 numbers, but NumberOfPoints is 6"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "NumberOfPoints=\"5\"", "NumberOfPoints=\"-5\"")),
             Contains("NumberOfPoints='-5'"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "NumberOfPolys=\"5\"", "NumberOfPolys=\"4\"")),
             Contains("5 offsets, but NumberOfPolys is 4"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "0 3 2 1", "0 3 7 1")), Contains("polygon 1 has point 7"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "Float64", "Float16")), Contains("type 'Float16'"));
  CHECK_THAT(refusalOf("a.vtp", withText(good, "Name=\"velocity\" NumberOfComponents=\"3\"",
                                         "Name=\"velocity\" NumberOfComponents=\"2\"")),
             Contains("'velocity' has 15 values in rows of 2"));
  VtpOptions raw;
  raw.format = VtpOptions::appendedRaw;
  CHECK_THAT(refusalOf("a.vtp", withText(vtp(raw), "offset=\"0\"", "offset=\"99999\"")),
             Contains("begins at byte 99999"));
  CHECK_THAT(refusalOf("a.vtp", withText(vtp(raw), "raw", "hex")), Contains("encoding 'hex'"));
}
