#include "caches/formats/vtk_text_arrays.h"

#include "sim/meshes/text_scan.h"

#include <string>

namespace fluidtex::caches {

namespace {

double numberOf(std::string_view word) {
  double number = 0.0;
  if (word.empty()) throw std::runtime_error("the file ends too early; write or copy it anew");
  if (!sim::parseNumber(word, number))
    throw std::runtime_error("holds " + sim::inQuotes(word) + ", which is not a number");
  return number;
}

}  // namespace

ArrayType arrayType(std::string_view name) {
  struct Named {
    std::string_view name;
    ArrayType type;
  };
  // vtkIdType is written as int, whatever it is in the program that writes.
  static const std::array<Named, 24> kTypes{{{"float", NumberType::float32},
                                             {"double", NumberType::float64},
                                             {"int", NumberType::int32},
                                             {"vtkidtype", NumberType::int32},
                                             {"unsigned_int", NumberType::uint32},
                                             {"long", NumberType::int64},
                                             {"unsigned_long", NumberType::uint64},
                                             {"long_long", NumberType::int64},
                                             {"unsigned_long_long", NumberType::uint64},
                                             {"vtktypeint64", NumberType::int64},
                                             {"vtktypeuint64", NumberType::uint64},
                                             {"vtktypeint32", NumberType::int32},
                                             {"vtktypeuint32", NumberType::uint32},
                                             {"__int64", NumberType::int64},
                                             {"unsigned___int64", NumberType::uint64},
                                             {"short", NumberType::int16},
                                             {"unsigned_short", NumberType::uint16},
                                             {"char", NumberType::int8},
                                             {"signed_char", NumberType::int8},
                                             {"unsigned_char", NumberType::uint8},
                                             {"vtktypefloat32", NumberType::float32},
                                             {"bit", ArrayType::bits},
                                             {"string", ArrayType::text},
                                             {"utf8_string", ArrayType::text}}};
  const std::string lower = sim::inLowerCase(name);
  for (const Named& of : kTypes)
    if (of.name == lower) return of.type;
  throw std::runtime_error("has " + sim::inQuotes(name) +
                           " where a type of numbers is needed (float, double, int, unsigned_char, ...)");
}

std::string_view TextArrays::takeLine() {
  m_rest.remove_prefix(std::min(m_rest.find_first_not_of(" \t\r\n"), m_rest.size()));
  return sim::takeLine(m_rest);
}

void TextArrays::takeTitle() {
  sim::takeLine(m_rest);
}

void TextArrays::skipParagraph() {
  while (!m_rest.empty() && sim::takeLine(m_rest).find_first_not_of(" \t") != std::string_view::npos) {
  }
}

bool TextArrays::nextIs(std::string_view word) const {
  const std::size_t at = m_rest.find_first_not_of(" \t\r\n");
  return at != std::string_view::npos && m_rest.substr(at).starts_with(word);
}

std::uint64_t TextArrays::countThatFits(std::uint64_t rows, std::uint64_t columns, std::uint64_t bits,
                                        std::uint64_t letters) const {
  const std::uint64_t room = binary ? 8 * m_rest.size() / bits : (m_rest.size() + 1) / letters;
  if (columns > 0 && rows > room / columns)
    throw std::runtime_error("says that it has " + std::to_string(rows) + " rows of " +
                             std::to_string(columns) +
                             ", for which the file is too short; write or copy it anew");
  return rows * columns;
}

template <class To>
std::vector<To> TextArrays::take(ArrayType type, std::uint64_t rows, std::uint64_t columns) {
  const std::uint64_t count = countThatFits(rows, columns, 8 * sizeOf(type.type));
  if (!binary) {
    std::vector<To> numbers(count);
    for (To& number : numbers) number = converted<To>(numberOf(sim::takeWord(m_rest)));
    return numbers;
  }
  const std::size_t size = count * sizeOf(type.type);
  std::vector<To> numbers = numbersOf<To>(m_rest.substr(0, size), type.type, std::endian::big);
  m_rest.remove_prefix(size);
  return numbers;
}

template std::vector<float> TextArrays::take<float>(ArrayType, std::uint64_t, std::uint64_t);
template std::vector<std::int64_t> TextArrays::take<std::int64_t>(ArrayType, std::uint64_t, std::uint64_t);

void TextArrays::skip(ArrayType type, std::uint64_t rows, std::uint64_t columns) {
  if (type.kind == ArrayType::text) {
    constexpr std::uint64_t kEmptyLine = 1;
    skipTexts(countThatFits(rows, columns, 8, kEmptyLine));
  } else if (!binary) {
    for (std::uint64_t count = countThatFits(rows, columns, 8); count > 0; --count)
      numberOf(sim::takeWord(m_rest));
  } else {
    const std::uint64_t bits = type.kind == ArrayType::bits ? 1 : 8 * sizeOf(type.type);
    m_rest.remove_prefix((countThatFits(rows, columns, bits) * bits + 7) / 8);
  }
}

// A line each; or their lengths, in 1, 2, 4 or 8 bytes as the two highest bits say, and their letters.
void TextArrays::skipTexts(std::uint64_t count) {
  for (; count > 0; --count) {
    if (!binary) {
      sim::takeLine(m_rest);
      continue;
    }
    Bytes bytes(m_rest, std::endian::big);
    const auto first = static_cast<unsigned char>(bytes.take(1)[0]);
    const std::size_t more = (std::size_t{1} << (3 - first / 64)) - 1;
    std::uint64_t length = first % 64;
    for (const char next : bytes.take(more)) length = length << 8 | static_cast<unsigned char>(next);
    bytes.take(length);
    m_rest.remove_prefix(m_rest.size() - bytes.size());
  }
}

}  // namespace fluidtex::caches
