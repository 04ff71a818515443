// Numbers out of the bytes of a file.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace fluidtex::caches {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

inline std::size_t sizeOf(NumberType type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

// The number that begins at a byte.
template <class Number>
Number numberAt(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> own;
  std::memcpy(own.data(), bytes, own.size());
  if (order != std::endian::native) std::reverse(own.begin(), own.end());
  return std::bit_cast<Number>(own);
}

// `number` as another type. Integers: of fractions the whole part; the ends of `To` stand for all integers
// that lie beyond them, its upper end for what is no number or beyond 2^62. As corners they are points that
// do not exist.
template <class To, class From>
To converted(From number) {
  if constexpr (std::is_floating_point_v<To>) {
    return static_cast<To>(number);
  } else if constexpr (std::is_floating_point_v<From>) {
    constexpr auto kMost = static_cast<double>(std::int64_t{1} << 62);
    if (!(std::abs(double(number)) < kMost)) return std::numeric_limits<To>::max();
    return converted<To>(static_cast<std::int64_t>(number));
  } else {
    if (std::in_range<To>(number)) return static_cast<To>(number);
    return std::cmp_less(number, 0) ? std::numeric_limits<To>::min() : std::numeric_limits<To>::max();
  }
}

// As many numbers as the bytes hold.
template <class To>
std::vector<To> numbersOf(std::string_view bytes, NumberType type, std::endian order) {
  std::vector<To> numbers(bytes.size() / sizeOf(type));
  const auto fill = [&]<class From>(From) {
    if constexpr (std::is_same_v<From, To>) {
      if (order == std::endian::native) {
        if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(To));
        return;
      }
    }
    const char* at = bytes.data();
    for (To& number : numbers) {
      number = converted<To>(numberAt<From>(at, order));
      at += sizeof(From);
    }
  };
  switch (type) {
    case NumberType::int8:
      fill(std::int8_t{});
      break;
    case NumberType::uint8:
      fill(std::uint8_t{});
      break;
    case NumberType::int16:
      fill(std::int16_t{});
      break;
    case NumberType::uint16:
      fill(std::uint16_t{});
      break;
    case NumberType::int32:
      fill(std::int32_t{});
      break;
    case NumberType::uint32:
      fill(std::uint32_t{});
      break;
    case NumberType::int64:
      fill(std::int64_t{});
      break;
    case NumberType::uint64:
      fill(std::uint64_t{});
      break;
    case NumberType::float32:
      fill(float{});
      break;
    case NumberType::float64:
      fill(double{});
  }
  return numbers;
}

// Bytes taken from the front, one thing after the other.
class Bytes {
 public:
  Bytes(std::string_view rest, std::endian order) : m_rest(rest), m_order(order) {}

  std::size_t size() const { return m_rest.size(); }

  // Throws std::runtime_error where there are fewer.
  std::string_view take(std::uint64_t count) {
    if (count > m_rest.size()) throw std::runtime_error("the file ends too early; write or copy it anew");
    const std::string_view taken = m_rest.substr(0, static_cast<std::size_t>(count));
    m_rest.remove_prefix(taken.size());
    return taken;
  }

  template <class Number>
  Number take() {
    return numberAt<Number>(take(sizeof(Number)).data(), m_order);
  }

 private:
  std::string_view m_rest;
  std::endian m_order;
};

}  // namespace fluidtex::caches
