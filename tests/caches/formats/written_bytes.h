// Files written byte by byte.
#pragma once

#include "tests/scratch.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace fluidtex::caches {

template <class Number>
void put(std::string& bytes, Number number, std::endian order = std::endian::little) {
  std::string own(reinterpret_cast<const char*>(&number), sizeof number);
  if (order != std::endian::native) std::reverse(own.begin(), own.end());
  bytes += own;
}

template <class Number>
std::string bytesOf(const std::vector<double>& numbers, std::endian order = std::endian::little) {
  std::string bytes;
  for (const double number : numbers) put(bytes, static_cast<Number>(number), order);
  return bytes;
}

inline std::string textOf(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) {
    std::array<char, 32> word;
    std::snprintf(word.data(), word.size(), "%.9g ", number);
    text += word.data();
  }
  return text + "\n";
}

inline std::string packed(const std::string& bytes, int windowBits) {
  z_stream stream{};
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
  std::string result(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  deflate(&stream, Z_FINISH);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

inline std::string gzipped(const std::string& bytes) {
  return packed(bytes, MAX_WBITS + 16);
}

inline std::string zlibbed(const std::string& bytes) {
  return packed(bytes, MAX_WBITS);
}

// A pyramid over a rectangle: what every format is to hold. Its faces point outward.
inline const std::vector<double> kPyramid{0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0, 1, 0.5, 3};
inline const std::vector<std::vector<double>> kPyramidFaces{
    {0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
inline const std::vector<double> kPyramidSpeeds{0.5, -1, 2, 1.5, -2, 3, 2.5, -3, 4, 3.5, -4, 5, 4.5, -5, 6};
inline constexpr double kPyramidVolume = 2.0;  // a third of 2 x 1 x 3

// A file in a folder of its own.
struct Written {
  Scratch scratch;
  std::filesystem::path path;
  Written(const std::string& name, const std::string& bytes) : path(scratch.path / name) {
    std::ofstream(path, std::ios::binary) << bytes;
  }
};

}  // namespace fluidtex::caches
