#include "caches/formats/numbers.h"

#include "tests/caches/formats/written_bytes.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;

namespace {

constexpr std::endian kOrders[] = {std::endian::little, std::endian::big};
constexpr auto kLowest = std::numeric_limits<std::int64_t>::min(),
               kHighest = std::numeric_limits<std::int64_t>::max();

// The least, the largest and a few others of a type come back as floats and as integers.
template <class Number>
void checkType(NumberType type) {
  using Limits = std::numeric_limits<Number>;
  CHECK(sizeOf(type) == sizeof(Number));
  const std::vector<Number> numbers{Limits::lowest(), Limits::max(), Number(0), Number(1), Number(100)};
  for (const std::endian order : kOrders) {
    CAPTURE(int(type), order == std::endian::big);
    std::string bytes;
    for (const Number number : numbers) put(bytes, number, order);
    const std::vector<float> floats = numbersOf<float>(bytes, type, order);
    const std::vector<std::int64_t> integers = numbersOf<std::int64_t>(bytes, type, order);
    REQUIRE(floats.size() == numbers.size());
    REQUIRE(integers.size() == numbers.size());
    for (std::size_t n = 0; n < numbers.size(); ++n) {
      if (type != NumberType::float64) CHECK(floats[n] == float(numbers[n]));
      if (n > 1) CHECK(integers[n] == std::int64_t(numbers[n]));
      CHECK(numberAt<Number>(bytes.data() + n * sizeof(Number), order) == numbers[n]);
    }
    if (sizeof(Number) < 8 && std::is_integral_v<Number>) {
      CHECK(integers[0] == std::int64_t(numbers[0]));
      CHECK(integers[1] == std::int64_t(numbers[1]));
    }
    // A part of a number is none.
    CHECK(numbersOf<float>(bytes.substr(0, 3 * sizeof(Number) - 1), type, order).size() == 2);
  }
}

}  // namespace

TEST_CASE("numbers: of each type, in both orders of bytes", "[caches]") {
  checkType<std::int8_t>(NumberType::int8);
  checkType<std::uint8_t>(NumberType::uint8);
  checkType<std::int16_t>(NumberType::int16);
  checkType<std::uint16_t>(NumberType::uint16);
  checkType<std::int32_t>(NumberType::int32);
  checkType<std::uint32_t>(NumberType::uint32);
  checkType<std::int64_t>(NumberType::int64);
  checkType<std::uint64_t>(NumberType::uint64);
  checkType<float>(NumberType::float32);
  checkType<double>(NumberType::float64);
}

TEST_CASE("numbers: big-endian ones begin with the highest byte", "[caches]") {
  const std::string bytes("\x01\x02\x03\x04\x05", 5);
  CHECK(numberAt<std::uint32_t>(bytes.data(), std::endian::big) == 0x01020304u);
  CHECK(numberAt<std::uint32_t>(bytes.data(), std::endian::little) == 0x04030201u);
  CHECK(numberAt<std::uint16_t>(bytes.data() + 3, std::endian::big) == 0x0405u);
  CHECK(numberAt<float>("\x3f\x80\x00\x00", std::endian::big) == 1.0f);
}

TEST_CASE("numbers: beyond what a type holds, its ends", "[caches]") {
  CHECK(converted<std::int64_t>(std::numeric_limits<std::uint64_t>::max()) == kHighest);
  CHECK(converted<std::int8_t>(-1000) == -128);
  CHECK(converted<std::int8_t>(1000u) == 127);
  CHECK(converted<std::uint32_t>(std::int64_t{-1}) == 0u);
  CHECK(converted<std::int8_t>(1000.0) == 127);
  CHECK(converted<std::int64_t>(kLowest) == kLowest);
  // As corners, numbers that are none or too large are no points.
  for (const double bad : {1e19, -1e19, 1e300, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()})
    CHECK(converted<std::int64_t>(bad) == kHighest);
  CHECK(converted<std::int64_t>(-7.0f) == -7);
  CHECK(converted<std::int64_t>(9007199254740992.0) == 9007199254740992);
}

TEST_CASE("numbers: integers become the nearest float", "[caches]") {
  CHECK(converted<float>(16777217) == 16777216.0f);
  CHECK(converted<float>(16777219) == 16777220.0f);
  CHECK(converted<float>(std::numeric_limits<std::uint64_t>::max()) == 18446744073709551616.0f);
}

TEST_CASE("numbers: bytes are taken from the front, and only those there are", "[caches]") {
  std::string text = "abc";
  put(text, std::uint16_t(0x0102), std::endian::big);
  put(text, 1.5f, std::endian::big);
  Bytes bytes(text, std::endian::big);
  CHECK(bytes.size() == 9);
  CHECK(bytes.take(3) == "abc");
  CHECK(bytes.take<std::uint16_t>() == 0x0102);
  CHECK_THROWS_WITH(bytes.take(5), Catch::Matchers::Contains("ends too early"));
  CHECK_THROWS(bytes.take<double>());
  CHECK_THROWS(bytes.take(std::numeric_limits<std::uint64_t>::max()));
  CHECK(bytes.size() == 4);
  CHECK(bytes.take<float>() == 1.5f);
  CHECK(bytes.take(0).empty());
  CHECK_THROWS(bytes.take(1));
}
