// G. Turk, "The PLY polygon file format", 1994.
#include "sim/meshes/mesh_formats.h"
#include "sim/meshes/text_scan.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace fluidtex::sim {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t sizeOf(Type type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  bool isList = false;
  Type type{}, countType{};
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  enum Format { text, littleEndian, bigEndian } format = text;
  std::vector<Element> elements;
};

Type typeOf(std::string_view word) {
  static constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                          {"uchar", "uint8"},
                                                                          {"short", "int16"},
                                                                          {"ushort", "uint16"},
                                                                          {"int", "int32"},
                                                                          {"uint", "uint32"},
                                                                          {"float", "float32"},
                                                                          {"double", "float64"}}};
  const std::string lower = inLowerCase(word);
  for (std::size_t n = 0; n < kNames.size(); ++n)
    if (lower == kNames[n][0] || lower == kNames[n][1]) return static_cast<Type>(n);
  throw std::runtime_error(inQuotes(word) +
                           " is no type of a number (char, uchar, short, ushort, int, uint, float, double)");
}

// One line of the header. Returns whether it is the last.
bool addHeaderLine(std::string_view words, Header& header) {
  const std::string_view keyword = takeWord(words);
  if (keyword.empty() || keyword == "comment" || keyword == "obj_info") return false;
  if (keyword == "end_header") return true;
  if (keyword == "format") {
    const std::string_view format = takeWord(words);
    if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
      throw std::runtime_error(inQuotes(format) +
                               " is no format; there are ascii, binary_little_endian, binary_big_endian");
    header.format = format == "ascii"                  ? Header::text
                    : format == "binary_little_endian" ? Header::littleEndian
                                                       : Header::bigEndian;
  } else if (keyword == "element") {
    Element& element = header.elements.emplace_back();
    element.name = takeWord(words);
    const std::string_view count = takeWord(words);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size())
      throw std::runtime_error("how many there are of element " + inQuotes(element.name) + " is " +
                               inQuotes(count) + ", no whole number of 0 or more");
  } else if (keyword == "property") {
    if (header.elements.empty()) throw std::runtime_error("a property before the first element");
    Property& property = header.elements.back().properties.emplace_back();
    std::string_view type = takeWord(words);
    property.isList = type == "list";
    if (property.isList) {
      property.countType = typeOf(takeWord(words));
      type = takeWord(words);
    }
    property.type = typeOf(type);
    property.name = takeWord(words);
  } else {
    throw std::runtime_error(inQuotes(keyword) + " begins no line of a PLY header");
  }
  return false;
}

// Takes the header off the bytes.
Header takeHeader(std::string_view& bytes) {
  Header header;
  bytes = withoutMark(bytes);
  if (takeLine(bytes).substr(0, 3) != "ply")
    throw std::runtime_error("is no PLY: it does not begin with 'ply'");
  bool formatGiven = false;
  for (std::size_t line = 2;; ++line) {
    if (bytes.empty()) throw std::runtime_error("its header has no end (end_header)");
    const std::string_view words = takeLine(bytes);
    try {
      formatGiven = formatGiven || words.starts_with("format");
      if (addHeaderLine(words, header)) break;
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("line " + std::to_string(line) + ": " + error.what());
    }
  }
  if (!formatGiven) throw std::runtime_error("its header has no line 'format'");
  return header;
}

std::string shown(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.12g", number);
  return text.data();
}

// Numbers behind the header, one by one.
class Numbers {
 public:
  Numbers(std::string_view bytes, Header::Format format) : m_rest(bytes), m_format(format) {}

  double take(Type type) { return m_format == Header::text ? takeText() : takeBinary(type); }

  // Whether so many more can be there. A number in a text takes two bytes, the last one a single one.
  bool holds(std::uint64_t count, std::uint64_t binarySize) const {
    const std::uint64_t each = m_format == Header::text ? 2 : binarySize;
    return count <= (m_rest.size() + 1) / each;
  }

 private:
  double takeText() {
    const std::string_view word = takeWord(m_rest);
    double number = 0.0;
    if (word.empty()) throw std::runtime_error("the file ends too early");
    if (!parseNumber(word, number))
      throw std::runtime_error("holds " + inQuotes(word) + ", which is not a number");
    return number;
  }

  template <class Number>
  double takeAs() {
    if (m_rest.size() < sizeof(Number)) throw std::runtime_error("the file ends too early");
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), m_rest.data(), bytes.size());
    m_rest.remove_prefix(bytes.size());
    if ((m_format == Header::littleEndian) != (std::endian::native == std::endian::little))
      std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<Number>(bytes));
  }

  double takeBinary(Type type) {
    switch (type) {
      case Type::int8:
        return takeAs<std::int8_t>();
      case Type::uint8:
        return takeAs<std::uint8_t>();
      case Type::int16:
        return takeAs<std::int16_t>();
      case Type::uint16:
        return takeAs<std::uint16_t>();
      case Type::int32:
        return takeAs<std::int32_t>();
      case Type::uint32:
        return takeAs<std::uint32_t>();
      case Type::float32:
        return takeAs<float>();
      case Type::float64:
        return takeAs<double>();
    }
    return 0.0;
  }

  std::string_view m_rest;
  Header::Format m_format;
};

// Bytes that one takes at least, lists being empty.
std::uint64_t leastSize(const Element& element) {
  std::uint64_t size = 0;
  for (const Property& property : element.properties)
    size += sizeOf(property.isList ? property.countType : property.type);
  return size;
}

std::vector<double> takeList(Numbers& numbers, const Property& property) {
  const double count = numbers.take(property.countType);
  if (!(count >= 0.0) || count != std::floor(count) || count > 4294967295.0 ||
      !numbers.holds(static_cast<std::uint64_t>(count), sizeOf(property.type)))
    throw std::runtime_error("a list of " + shown(count) + " numbers, for which the file is too short");
  std::vector<double> list(static_cast<std::size_t>(count));
  for (double& number : list) number = numbers.take(property.type);
  return list;
}

std::size_t vertexOf(double index) {
  if (!(index >= 0.0) || index != std::floor(index) || index > 4294967295.0)
    throw std::runtime_error("names vertex " + shown(index) + "; they are whole numbers from 0 on");
  return static_cast<std::size_t>(index);
}

// Every vertex of a strip makes a triangle with the two before it, turned every other time; -1, or its bits
// in a type without a sign, ends it.
void addStrips(const std::vector<double>& list, std::vector<std::vector<std::size_t>>& polygons) {
  std::vector<std::size_t> strip;
  for (const double index : list) {
    if (index == -1.0 || index == 4294967295.0) {
      strip.clear();
      continue;
    }
    strip.push_back(vertexOf(index));
    if (strip.size() < 3) continue;
    const std::size_t a = strip[strip.size() - 3], b = strip[strip.size() - 2], c = strip.back();
    if (a == b || b == c || c == a) continue;  // only leads the strip on
    strip.size() % 2 == 1 ? polygons.push_back({a, b, c}) : polygons.push_back({b, a, c});
  }
}

bool isCorners(const Property& property) {
  return property.isList && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// The places of x, y and z among an element's properties.
std::array<std::size_t, 3> placesOf(const Element& vertex) {
  std::array<std::size_t, 3> places{};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string name(1, "xyz"[a]);
    const auto at = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                 [&](const Property& p) { return !p.isList && inLowerCase(p.name) == name; });
    if (at == vertex.properties.end())
      throw std::runtime_error("its vertices have no property '" + name + "'");
    places[a] = static_cast<std::size_t>(at - vertex.properties.begin());
  }
  return places;
}

// The places of properties among an element's, and what takes their values.
struct Kept {
  std::vector<std::size_t> places;
  std::size_t first = 0;  // of `others`
};

// Those that are no lists and not where the vertex is; adds them to `others`.
Kept keptOf(const Element& vertex, const std::array<std::size_t, 3>& position,
            std::vector<VertexProperty>& others) {
  Kept kept{{}, others.size()};
  for (std::size_t p = 0; p < vertex.properties.size(); ++p) {
    if (vertex.properties[p].isList || std::find(position.begin(), position.end(), p) != position.end())
      continue;
    kept.places.push_back(p);
    others.push_back({vertex.properties[p].name, {}});
  }
  return kept;
}

void takeElement(const Element& element, Numbers& numbers, MeshSoup& soup,
                 std::vector<VertexProperty>* others) {
  const bool isVertex = element.name == "vertex", isFace = element.name == "face",
             isStrips = element.name == "tristrips";
  const std::array<std::size_t, 3> places = isVertex ? placesOf(element) : std::array<std::size_t, 3>{};
  if ((isFace || isStrips) && element.count > 0 &&
      std::none_of(element.properties.begin(), element.properties.end(), isCorners))
    throw std::runtime_error("its " + element.name + " elements have no list 'vertex_indices'");
  const Kept kept = isVertex && others ? keptOf(element, places, *others) : Kept{};
  std::vector<double> values(element.properties.size());
  const auto takeOne = [&] {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      if (!property.isList) {
        values[p] = numbers.take(property.type);
        continue;
      }
      const std::vector<double> list = takeList(numbers, property);
      if (isStrips && isCorners(property)) addStrips(list, soup.polygons);
      if (!isFace || !isCorners(property)) continue;
      std::vector<std::size_t>& polygon = soup.polygons.emplace_back();
      for (const double index : list) polygon.push_back(vertexOf(index));
      // One corner or two bound nothing.
      if (polygon.size() < 3) soup.polygons.pop_back();
    }
    if (isVertex) soup.points.emplace_back(values[places[0]], values[places[1]], values[places[2]]);
    for (std::size_t n = 0; n < kept.places.size(); ++n)
      (*others)[kept.first + n].values.push_back(static_cast<float>(values[kept.places[n]]));
  };
  for (std::uint64_t n = 0; n < element.count; ++n) {
    try {
      takeOne();
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(element.name + " " + std::to_string(n + 1) + " of " +
                               std::to_string(element.count) + ": " + error.what());
    }
  }
}

}  // namespace

MeshSoup soupOfPly(std::string_view bytes, std::vector<VertexProperty>* others) {
  const Header header = takeHeader(bytes);
  Numbers numbers(bytes, header.format);
  MeshSoup soup;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    if (!numbers.holds(element.count, leastSize(element)))
      throw std::runtime_error("says it has " + std::to_string(element.count) + " elements '" + element.name +
                               "', for which it is too short");
    takeElement(element, numbers, soup, others);
  }
  return soup;
}

}  // namespace fluidtex::sim
