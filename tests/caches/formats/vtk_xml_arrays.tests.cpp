#include "caches/formats/vtk_xml_arrays.h"

#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

#include <pugixml.hpp>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr std::uint64_t kRoom = 1000;

// The array "v" of PointData, with these attributes and this text.
template <class To = float>
std::vector<To> arrayOf(const std::string& attributes, const std::string& text, XmlArrays file = {}) {
  pugi::xml_document document;
  REQUIRE(document.load_string(
      ("<PointData><DataArray Name=\"v\" " + attributes + ">" + text + "</DataArray></PointData>").c_str()));
  if (file.room == 0) file.room = kRoom;
  return numbersOf<To>(document.child("PointData").child("DataArray"), file);
}

std::string sized(const std::string& bytes, std::endian order = std::endian::little) {
  std::string all;
  put(all, std::uint32_t(bytes.size()), order);
  return all + bytes;
}

std::uint64_t countIn(const std::string& value) {
  pugi::xml_document document;
  REQUIRE(document.load_string(("<Piece NumberOfPoints=\"" + value + "\"/>").c_str()));
  return countOf(document.child("Piece"), "NumberOfPoints");
}

XmlArrays appendedTo(std::string_view bytes) {
  XmlArrays file;
  file.appended = bytes;
  return file;
}

}  // namespace

TEST_CASE("vtk xml arrays: words, bytes in base64, and bytes behind all else", "[caches]") {
  const std::vector<float> numbers{1, -2, 300};
  CHECK(arrayOf("type=\"Float64\" format=\"ascii\"", "\n 1 -2\t3e2 \n") == numbers);
  CHECK(arrayOf("type=\"Int8\" format=\"ascii\"", "").empty());
  const std::string little = sized(bytesOf<std::int16_t>({1, -2, 300}));
  CHECK(arrayOf("type=\"Int16\" format=\"binary\"", "\n " + base64Of(little) + "\n") == numbers);
  CHECK(arrayOf("type=\"Int16\" format=\"binary\"", " \n").empty());
  const std::string appended = "..." + little;
  CHECK(arrayOf("type=\"Int16\" format=\"appended\" offset=\"3\"", "", appendedTo(appended)) == numbers);
  const std::string coded = base64Of("abc") + base64Of(little);
  XmlArrays file = appendedTo(coded);
  file.appendedIsBase64 = true;
  CHECK(arrayOf("type=\"Int16\" format=\"appended\" offset=\"4\"", "", file) == numbers);
  CHECK(arrayOf<std::int64_t>("type=\"Int16\" format=\"appended\" offset=\"4\"", "", file) ==
        std::vector<std::int64_t>{1, -2, 300});
}

TEST_CASE("vtk xml arrays: lengths of eight bytes, and the highest byte first", "[caches]") {
  std::string bytes;
  put(bytes, std::uint64_t(8), std::endian::big);
  bytes += bytesOf<float>({0.5, 7}, std::endian::big);
  XmlArrays file = appendedTo(bytes);
  file.order = std::endian::big;
  file.headerType = NumberType::uint64;
  CHECK(arrayOf("type=\"Float32\" format=\"appended\" offset=\"0\"", "", file) == std::vector<float>{0.5, 7});
}

TEST_CASE("vtk xml arrays: packed in blocks, of which the last is shorter, as long or there are none",
          "[caches]") {
  const auto packedIn = [](const std::vector<std::vector<double>>& blocks, std::uint32_t full,
                           std::uint32_t last) {
    std::string lengths, all;
    for (const std::uint32_t n : {std::uint32_t(blocks.size()), full, last}) put(lengths, n);
    for (const auto& block : blocks) {
      const std::string one = zlibbed(bytesOf<float>(block));
      put(lengths, std::uint32_t(one.size()));
      all += one;
    }
    const std::string bytes = lengths + all;
    XmlArrays file = appendedTo(bytes);
    file.isPacked = true;
    return arrayOf("type=\"Float32\" format=\"appended\" offset=\"0\"", "", file);
  };
  CHECK(packedIn({{1, 2}, {3, 4}, {5}}, 8, 4) == std::vector<float>{1, 2, 3, 4, 5});
  CHECK(packedIn({{1, 2}, {3, 4}}, 8, 0) == std::vector<float>{1, 2, 3, 4});
  CHECK(packedIn({{1, 2}}, 100, 8) == std::vector<float>{1, 2});
  CHECK(packedIn({}, 0, 0).empty());
  CHECK_THROWS_WITH(packedIn({{1, 2}, {3, 4}}, 8, 4), Contains("packed by zlib is damaged"));
}

TEST_CASE("vtk xml arrays: what is wrong is said of the array", "[caches]") {
  CHECK_THROWS_WITH(arrayOf("type=\"Float16\" format=\"ascii\"", "1"),
                    StartsWith("array 'v' in PointData: ") && Contains("is of type 'Float16'"));
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"hex\"", "1"), Contains("is in format 'hex'"));
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"ascii\"", "1 two"),
                    Contains("holds 'two', which is not a number"));
  CHECK_THROWS_WITH(arrayOf("type=\"Int16\" format=\"binary\"", base64Of(sized("abc"))),
                    Contains("has 3 bytes, and each number takes 2"));
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"appended\" offset=\"4\"", "", appendedTo("abc")),
                    Contains("begins at byte 4 of the appended data, which has 3"));
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"appended\"", "", appendedTo("abc")),
                    Contains("offset=''"));
  const std::string large = sized("abc").substr(0, 6);
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"appended\" offset=\"0\"", "", appendedTo(large)),
                    Contains("needs 7 bytes"));
  const std::string huge =
      "\xff\xff\xff\xff"
      "abc";
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"appended\" offset=\"0\"", "", appendedTo(huge)),
                    Contains("says that it takes 4294967295 bytes"));
  XmlArrays packed = appendedTo(huge);
  packed.isPacked = true;
  CHECK_THROWS_WITH(arrayOf("type=\"Int8\" format=\"appended\" offset=\"0\"", "", packed),
                    Contains("says that it has 4294967295 blocks"));
}

TEST_CASE("vtk xml arrays: each takes of the room what it has in the file", "[caches]") {
  const std::string bytes = sized("abc") + sized("de");
  XmlArrays file = appendedTo(bytes);
  file.room = bytes.size();
  pugi::xml_document document;
  REQUIRE(
      document.load_string("<P><A type=\"UInt8\" format=\"appended\" offset=\"0\"/>"
                           "<B type=\"UInt8\" format=\"appended\" offset=\"7\"/></P>"));
  CHECK(numbersOf<float>(document.child("P").child("A"), file).size() == 3);
  CHECK(file.room == 6);
  CHECK_THROWS_WITH(numbersOf<float>(document.child("P").child("A"), file),
                    Contains("other arrays have taken"));
  CHECK(numbersOf<float>(document.child("P").child("B"), file) == std::vector<float>{'d', 'e'});
  CHECK(file.room == 0);
}

TEST_CASE("vtk xml arrays: counts are whole numbers of 0 or more", "[caches]") {
  CHECK(countIn("0") == 0);
  CHECK(countIn("18446744073709551615") == 18446744073709551615u);
  for (const char* bad : {"", "-1", "1.5", "5 ", "18446744073709551616", "five"})
    CHECK_THROWS_WITH(countIn(bad), Contains("Piece has NumberOfPoints='" + std::string(bad) + "'"));
}

TEST_CASE("vtk xml arrays: a packed block cannot claim more than it can hold", "[caches]") {
  VtpOptions options;
  options.format = VtpOptions::appendedRaw;
  options.packed = true;
  options.blockSize = 1000;
  std::string bytes = vtp(options);
  // Of the first array: one block, of so many bytes unpacked.
  const std::size_t header = bytes.find("_", bytes.find("<AppendedData")) + 1;
  bytes[header + 7] = bytes[header + 11] = '\x7f';
  CHECK_THAT(refusalOf("a.vtp", bytes), Contains("block 1 of 1 cannot hold"));
}

TEST_CASE("vtk xml arrays: arrays at one place do not take more memory than the file", "[caches]") {
  const auto array = [](const std::string& name) {
    return "<DataArray type=\"Float32\" Name=\"" + name +
           "\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/>";
  };
  std::string values;
  put(values, std::uint32_t(12000));
  values += std::string(12000, '\0');
  const auto file = [&](const std::string& attributes) {
    return "<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"1000\"><PointData>" + attributes +
           "</PointData><Points>" + array("Points") +
           "</Points></Piece></PolyData><AppendedData encoding=\"raw\">_" + values +
           "</AppendedData></VTKFile>";
  };
  CHECK(geometryIn("a.vtp", file("")).points.size() == 1000);
  CHECK_THAT(refusalOf("a.vtp", file(array("a") + array("b"))),
             Contains("bytes that other arrays have taken"));
}
