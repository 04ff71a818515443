#include "caches/formats/vtk_text_arrays.h"

#include "tests/caches/formats/written_bytes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

constexpr std::uint64_t kFarTooMany = std::uint64_t{1} << 62;

TextArrays binary(std::string_view bytes) {
  TextArrays arrays(bytes);
  arrays.binary = true;
  return arrays;
}

}  // namespace

TEST_CASE("vtk text arrays: types by the names that programs write, in capitals or not", "[caches]") {
  const auto is = [](const char* name, NumberType type) {
    const ArrayType found = arrayType(name);
    return found.isNumber() && found.type == type;
  };
  CHECK(is("float", NumberType::float32));
  CHECK(is("Double", NumberType::float64));
  CHECK(is("char", NumberType::int8));
  CHECK(is("unsigned_char", NumberType::uint8));
  CHECK(is("short", NumberType::int16));
  CHECK(is("unsigned_short", NumberType::uint16));
  CHECK(is("int", NumberType::int32));
  CHECK(is("vtkIdType", NumberType::int32));
  CHECK(is("unsigned_int", NumberType::uint32));
  CHECK(is("long", NumberType::int64));
  CHECK(is("vtktypeint64", NumberType::int64));
  CHECK(is("UNSIGNED_LONG", NumberType::uint64));
  CHECK(arrayType("bit").kind == ArrayType::bits);
  CHECK(arrayType("string").kind == ArrayType::text);
  CHECK(arrayType("utf8_string").kind == ArrayType::text);
  CHECK_THROWS_WITH(arrayType("half"), Contains("has 'half' where a type of numbers is needed"));
  CHECK_THROWS(arrayType(""));
}

TEST_CASE("vtk text arrays: lines, of which blank ones are skipped, and paragraphs", "[caches]") {
  TextArrays arrays("\n \t\nPOINTS 5\r\n\r\ntitle\n\nMETADATA\nNAME x\n \nCELLS 1\rEND");
  CHECK(arrays.nextIs("POINTS"));
  CHECK_FALSE(arrays.nextIs("CELLS"));
  CHECK(arrays.takeLine() == "POINTS 5");
  arrays.takeTitle();  // the blank one
  CHECK(arrays.takeLine() == "title");
  arrays.takeTitle();
  CHECK(arrays.nextIs("META"));
  arrays.skipParagraph();
  CHECK(arrays.takeLine() == "CELLS 1");
  CHECK(arrays.takeLine() == "END");
  CHECK(arrays.takeLine().empty());
  CHECK_FALSE(arrays.nextIs(""));
  arrays.skipParagraph();  // ends at the end
}

TEST_CASE("vtk text arrays: numbers as words, over the ends of lines", "[caches]") {
  TextArrays arrays(" 1 +2.5e1\n-3\t4\r\n5 6 POINTS");
  CHECK(arrays.take<float>(NumberType::float32, 2, 2) == std::vector<float>{1, 25, -3, 4});
  CHECK(arrays.take<std::int64_t>(NumberType::int32, 1, 1) == std::vector<std::int64_t>{5});
  CHECK(arrays.take<float>(NumberType::float32, 0, 3).empty());
  CHECK(arrays.take<float>(NumberType::float32, 3, 0).empty());
  arrays.skip(NumberType::float64, 1, 1);
  CHECK(arrays.takeLine() == "POINTS");
  CHECK_THROWS_WITH(TextArrays("1 two").take<float>(NumberType::float32, 1, 2),
                    Contains("holds 'two', which is not a number"));
  CHECK_THROWS_WITH(TextArrays("1    ").take<float>(NumberType::float32, 1, 2), Contains("ends too early"));
  CHECK_THROWS_WITH(TextArrays("1 two").skip(NumberType::float32, 1, 2), Contains("'two'"));
  // The last of them takes a single byte.
  CHECK(TextArrays("1 2").take<float>(NumberType::float32, 2, 1) == std::vector<float>{1, 2});
}

TEST_CASE("vtk text arrays: numbers as bytes, the highest first", "[caches]") {
  TextArrays arrays = binary("\x01\x02\xff\xfe\nnext");
  CHECK(arrays.take<std::int64_t>(NumberType::int16, 1, 2) == std::vector<std::int64_t>{0x0102, -2});
  CHECK(arrays.takeLine() == "next");
  const std::string five = bytesOf<double>({1, 2, 3, 4, 5}, std::endian::big);
  TextArrays doubles = binary(five);
  doubles.skip(NumberType::float64, 1, 2);
  CHECK(doubles.take<float>(NumberType::float64, 3, 1) == std::vector<float>{3, 4, 5});
  CHECK_THROWS_WITH(binary(five).take<float>(NumberType::float64, 2, 3),
                    Contains("has 2 rows of 3, for which the file is too short"));
  CHECK_THROWS(binary(five).skip(NumberType::float64, 6, 1));
}

TEST_CASE("vtk text arrays: rows that the file cannot hold take no memory", "[caches]") {
  for (const bool isBinary : {false, true}) {
    TextArrays arrays("1 2 3 4 5");
    arrays.binary = isBinary;
    CHECK_THROWS_WITH(arrays.take<float>(NumberType::float32, kFarTooMany, 4), Contains("too short"));
    CHECK_THROWS_WITH(arrays.take<float>(NumberType::float32, 4, kFarTooMany), Contains("too short"));
    CHECK_THROWS_WITH(arrays.skip(NumberType::float32, kFarTooMany, 8), Contains("too short"));
    CHECK_THROWS_WITH(arrays.skip(ArrayType::text, kFarTooMany, 1), Contains("too short"));
    CHECK_THROWS_WITH(arrays.skip(ArrayType::bits, kFarTooMany, 32), Contains("too short"));
  }
}

TEST_CASE("vtk text arrays: bits take an eighth of a byte, or a word each", "[caches]") {
  for (const auto& [count, bytes] : {std::pair(8, 1), std::pair(9, 2), std::pair(16, 2)}) {
    TextArrays arrays = binary("ab\ncd");
    arrays.skip(ArrayType::bits, std::uint64_t(count), 1);
    CHECK(arrays.takeLine() == (bytes == 1 ? "b" : "cd"));
  }
  TextArrays words("1 0 1 rest");
  words.skip(ArrayType::bits, 3, 1);
  CHECK(words.takeLine() == "rest");
}

TEST_CASE("vtk text arrays: texts are lines, or letters behind a length of one to eight bytes", "[caches]") {
  TextArrays lines("a\n\nb b\nPOINTS");
  lines.skip(ArrayType::text, 3, 1);
  CHECK(lines.takeLine() == "POINTS");
  TextArrays none("\n\n\n\n");
  none.skip(ArrayType::text, 4, 1);
  CHECK(none.takeLine().empty());
  CHECK_THROWS(TextArrays("\n\n\n\n").skip(ArrayType::text, 6, 1));
  const auto text = [](const std::string& length, std::size_t count) {
    return length + std::string(count, 'x');
  };
  const std::string one = text("\xc3", 3), two = text(std::string("\x81\x02", 2), 0x102),
                    four = text(std::string("\x40\x00\x01\x05", 4), 0x105),
                    eight = text(std::string("\x00\x00\x00\x00\x00\x00\x00\x02", 8), 2);
  for (const std::string& all :
       {one + two + four + eight, eight + one + four + two, four + two + eight + one}) {
    const std::string bytes = all + "end";
    TextArrays arrays = binary(bytes);
    arrays.skip(ArrayType::text, 4, 1);
    CHECK(arrays.takeLine() == "end");
  }
  CHECK_THROWS(binary("\xc4xxx").skip(ArrayType::text, 1, 1));
  CHECK_THROWS(binary("\x81").skip(ArrayType::text, 1, 1));
}
