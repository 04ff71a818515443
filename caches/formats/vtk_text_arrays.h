// Lines and arrays of legacy VTK files.
#pragma once

#include "caches/formats/numbers.h"

#include <string_view>

namespace fluidtex::caches {

struct ArrayType {
  enum Kind { number, bits, text } kind = number;
  NumberType type{};

  ArrayType(NumberType of) : type(of) {}
  ArrayType(Kind of) : kind(of) {}
  bool isNumber() const { return kind == number; }
};

// By its name in a file. Throws std::runtime_error.
ArrayType arrayType(std::string_view name);

// All throw std::runtime_error where the file is too short or holds other than numbers.
class TextArrays {
 public:
  explicit TextArrays(std::string_view bytes) : m_rest(bytes) {}

  bool binary = false;  // big-endian; else words

  // The next line that is not blank; empty at the end.
  std::string_view takeLine();

  // The next line, be it blank.
  void takeTitle();

  // Skips all up to a blank line.
  void skipParagraph();

  // Whether the next line begins with a word.
  bool nextIs(std::string_view word) const;

  // Rows of numbers.
  template <class To>
  std::vector<To> take(ArrayType type, std::uint64_t rows, std::uint64_t columns);

  void skip(ArrayType type, std::uint64_t rows, std::uint64_t columns);

  // Colours are bytes, or floats where they are written as text.
  ArrayType bytesOrText() const { return binary ? NumberType::uint8 : NumberType::float32; }

 private:
  // rows * columns, of which the rest of the file has enough bytes, each taking `bits` at least where the
  // file is binary, else `letters` with what ends it, which the last one may lack.
  std::uint64_t countThatFits(std::uint64_t rows, std::uint64_t columns, std::uint64_t bits,
                              std::uint64_t letters = 2) const;
  void skipTexts(std::uint64_t count);

  std::string_view m_rest;
};

}  // namespace fluidtex::caches
