// Files for tests of readers: gone when the test ends.
#pragma once

#include <unistd.h>

#include <algorithm>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace fluidtex::sim {

struct WrittenFile {
  inline static int count = 0;
  std::filesystem::path path;

  // `name`: "box.obj"
  WrittenFile(const std::string& name, const std::string& content)
      : path(std::filesystem::temp_directory_path() /
             ("fluidtex_" + std::to_string(::getpid()) + "_" + std::to_string(++count) + "_" + name)) {
    std::ofstream(path, std::ios::binary) << content;
  }
  ~WrittenFile() { std::filesystem::remove(path); }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;
};

template <class Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// One field of a TIFF's directory: its tag, its type (2: text, 3: 16 bits, 4: 32 bits), and its value, as
// text or as a number.
struct TiffField {
  std::uint16_t tag, type;
  std::uint32_t number = 0;
  std::string text{};
};

// An uncompressed TIFF of one strip. Fields in rising order of tags; others are those that every file needs.
inline std::string tiffBytes(std::uint16_t width, std::uint16_t height, std::uint16_t bits,
                             std::uint16_t samples, const std::string& pixels,
                             const std::vector<TiffField>& more = {}) {
  std::vector<TiffField> fields{{256, 3, width},   {257, 3, height}, {258, 3, bits},
                                {259, 3, 1},       {262, 3, 1},      {273, 4, 8},
                                {277, 3, samples}, {278, 3, height}, {279, 4, std::uint32_t(pixels.size())}};
  if (samples == 2) fields[2].number = bits | std::uint32_t(bits) << 16;
  for (const TiffField& field : more) fields.push_back(field);
  std::sort(fields.begin(), fields.end(), [](const auto& a, const auto& b) { return a.tag < b.tag; });
  std::string bytes = "II*";
  bytes += '\0';
  append(bytes, std::uint32_t(8 + pixels.size()));
  bytes += pixels;
  append(bytes, std::uint16_t(fields.size()));
  std::string texts;
  for (const TiffField& field : fields) {
    append(bytes, field.tag);
    append(bytes, field.type);
    const std::uint32_t count = field.type == 2    ? std::uint32_t(field.text.size() + 1)
                                : field.tag == 258 ? samples
                                                   : 1u;
    append(bytes, count);
    if (field.type == 2 && count <= 4) {
      std::string inPlace = field.text;
      inPlace.resize(4);
      bytes += inPlace;
    } else if (field.type == 2) {
      append(bytes, std::uint32_t(8 + pixels.size() + 2 + 12 * fields.size() + 4 + texts.size()));
      texts += field.text;
      texts += '\0';
    } else {
      append(bytes, field.number);
    }
  }
  append(bytes, std::uint32_t(0));
  return bytes + texts;
}

// An SGI of 8 x 8 pixels of 8 bits, rows from the bottom: 30 a column and 1 a row. `damaged`: in runs, whose
// rows have one byte, by which 127 values follow; the library at hand asserts that they do.
inline std::string sgiBytes(bool damaged = false) {
  std::string bytes("\x01\xda\0\1\0\2\0\x08\0\x08\0\1\0\0\0\0\0\0\0\xff", 20);
  bytes.resize(512);
  for (int n = 0; n < 64 && !damaged; ++n) bytes.push_back(static_cast<char>(30 * (n % 8) + n / 8));
  if (!damaged) return bytes;
  bytes[2] = 1;
  for (int row = 0; row < 8; ++row) bytes.append("\0\0\2\x40", 4);  // where the row's bytes are
  for (int row = 0; row < 8; ++row) bytes.append("\0\0\0\1", 4);    // and how many
  bytes.push_back('\xff');
  return bytes;
}

}  // namespace fluidtex::sim
