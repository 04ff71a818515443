// Kitware, "VTK XML Formats": lengths, then values. Packed: the number of blocks, how long each is unpacked,
// how long the last one is (0: as the others), how long each is packed, and the blocks.
#include "caches/formats/vtk_xml_arrays.h"

#include "caches/formats/base64.h"
#include "caches/formats/build_geometry.h"
#include "caches/formats/gzip.h"
#include "sim/meshes/text_scan.h"

namespace fluidtex::caches {

namespace {

NumberType typeOf(std::string_view name) {
  static constexpr std::array<std::string_view, 10> kNames{"Int8",   "UInt8", "Int16",  "UInt16",  "Int32",
                                                           "UInt32", "Int64", "UInt64", "Float32", "Float64"};
  for (std::size_t n = 0; n < kNames.size(); ++n)
    if (name == kNames[n]) return static_cast<NumberType>(n);
  throw std::runtime_error("is of type " + sim::inQuotes(name) +
                           "; expected Int8 to UInt64, Float32 or Float64");
}

// Bytes that begin somewhere in the file, as they are or in base64.
struct Source {
  std::string_view text;
  bool isBase64;

  // So many from the beginning.
  std::string front(std::uint64_t count) const {
    if (count > text.size())
      throw std::runtime_error("needs " + counted(count, "byte") +
                               ", but the file ends before; write or copy it anew");
    return isBase64 ? fromBase64(text, count) : std::string(text.substr(0, count));
  }
};

// Arrays that all begin at one place would take far more memory than the file.
void takeRoom(std::uint64_t count, XmlArrays& file) {
  if (count > file.room)
    throw std::runtime_error("takes bytes that other arrays have taken; each has its own");
  file.room -= count;
}

std::string plainBytes(const Source& source, XmlArrays& file) {
  const std::size_t header = sizeOf(file.headerType);
  const std::string length = source.front(header);
  const auto size = numbersOf<std::uint64_t>(length, file.headerType, file.order)[0];
  if (size > source.text.size())
    throw std::runtime_error("says that it takes " + counted(size, "byte") +
                             ", but the file ends before; write or copy it anew");
  takeRoom(header + size, file);
  return source.front(header + size).substr(header);
}

std::string unpackedBytes(const Source& source, XmlArrays& file) {
  const std::size_t each = sizeOf(file.headerType);
  const auto header = [&](std::uint64_t count) {
    return numbersOf<std::uint64_t>(source.front(count * each), file.headerType, file.order);
  };
  const std::uint64_t blocks = header(1)[0];
  if (blocks == 0) return {};
  if (blocks > source.text.size() / each)
    throw std::runtime_error("says that it has " + counted(blocks, "block") +
                             ", for which the file is too short; write or copy it anew");
  const std::vector<std::uint64_t> lengths = header(3 + blocks);
  const std::uint64_t full = lengths[1], last = lengths[2] == 0 ? full : lengths[2];
  std::uint64_t packed = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::uint64_t size = lengths[3 + b];
    if (size > source.text.size() || !canHold(size, b + 1 < blocks ? full : last))
      throw std::runtime_error("block " + std::to_string(b + 1) + " of " + std::to_string(blocks) +
                               " cannot hold what it says, or the file ends before; write or copy it anew");
    packed += size;
  }
  const std::size_t begin = (3 + blocks) * each;
  takeRoom(begin + packed, file);
  const std::string bytes = source.front(begin + packed);
  std::string result((blocks - 1) * full + last, '\0');
  std::size_t from = begin, to = 0;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const std::size_t size = b + 1 < blocks ? full : last;
    unpackZlib(std::string_view(bytes).substr(from, lengths[3 + b]), result.data() + to, size);
    from += lengths[3 + b];
    to += size;
  }
  return result;
}

template <class To>
std::vector<To> numbersOfText(std::string_view text) {
  std::vector<To> numbers;
  for (std::string_view word = sim::takeWord(text); !word.empty(); word = sim::takeWord(text)) {
    double number = 0.0;
    if (!sim::parseNumber(word, number))
      throw std::runtime_error("holds " + sim::inQuotes(word) + ", which is not a number");
    numbers.push_back(converted<To>(number));
  }
  return numbers;
}

template <class To>
std::vector<To> read(const pugi::xml_node& array, XmlArrays& file) {
  const NumberType type = typeOf(array.attribute("type").value());
  const std::string_view format = array.attribute("format").value();
  std::string_view text = array.text().get();
  if (format == "ascii") return numbersOfText<To>(text);
  Source source{text, true};
  if (format == "appended") {
    const std::uint64_t offset = countOf(array, "offset");
    if (offset > file.appended.size())
      throw std::runtime_error("begins at byte " + std::to_string(offset) +
                               " of the appended data, which has " + std::to_string(file.appended.size()));
    source = {file.appended.substr(offset), file.appendedIsBase64};
  } else if (format == "binary") {
    // Blanks before it count as bytes that can be there, else for nothing.
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return {};
  } else {
    throw std::runtime_error("is in format " + sim::inQuotes(format) +
                             "; expected ascii, binary or appended");
  }
  const std::string bytes = file.isPacked ? unpackedBytes(source, file) : plainBytes(source, file);
  if (bytes.size() % sizeOf(type) != 0)
    throw std::runtime_error("has " + counted(bytes.size(), "byte") + ", and each number takes " +
                             std::to_string(sizeOf(type)));
  return numbersOf<To>(bytes, type, file.order);
}

}  // namespace

template <class To>
std::vector<To> numbersOf(const pugi::xml_node& array, XmlArrays& file) {
  try {
    return read<To>(array, file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("array " + sim::inQuotes(array.attribute("Name").value()) + " in " +
                             array.parent().name() + ": " + error.what());
  }
}

template std::vector<float> numbersOf<float>(const pugi::xml_node&, XmlArrays&);
template std::vector<std::int64_t> numbersOf<std::int64_t>(const pugi::xml_node&, XmlArrays&);

std::uint64_t countOf(const pugi::xml_node& node, const char* attribute) {
  const std::string_view word = node.attribute(attribute).value();
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    throw std::runtime_error(std::string(node.name()) + " has " + attribute + "=" + sim::inQuotes(word) +
                             "; a whole number of 0 or more is needed");
  return count;
}

}  // namespace fluidtex::caches
