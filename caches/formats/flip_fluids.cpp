// FLIP Fluids, bakefiles: little-endian, without a header.
#include "caches/formats/flip_fluids.h"

#include "caches/formats/file_content.h"
#include "caches/formats/geometry_formats.h"
#include "caches/formats/numbers.h"

#include <nlohmann/json.hpp>

#include <string>

namespace fluidtex::caches {

namespace {

template <class Number>
std::vector<Number> valuesOf(const std::filesystem::path& file, NumberType type) {
  // No vertices: no bytes.
  if (std::filesystem::is_regular_file(file) && std::filesystem::file_size(file) == 0) return {};
  const std::string content = contentOf(file);
  if (content.size() % sizeof(Number) != 0)
    fail(file, "has " + std::to_string(content.size()) + " bytes; each value takes " +
                   std::to_string(sizeof(Number)));
  return numbersOf<Number>(content, type, std::endian::little);
}

[[noreturn]] void failAt(const std::filesystem::path& file, std::size_t vertex) {
  fail(file, "the value of vertex " + std::to_string(vertex + 1) + " is not finite; bake it anew");
}

}  // namespace

std::vector<openvdb::Vec3f> readFlipVectors(const std::filesystem::path& file) {
  const std::string content = contentOf(file);
  Geometry geometry;
  try {
    geometry = geometryOfBobj(content);
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
  if (!geometry.triangles.empty()) fail(file, "holds a mesh; expected vectors, as in velocity000001.bobj");
  for (std::size_t n = 0; n < geometry.points.size(); ++n)
    if (!geometry.points[n].isFinite()) failAt(file, n);
  return std::move(geometry.points);
}

std::vector<float> readFlipFloats(const std::filesystem::path& file) {
  std::vector<float> values = valuesOf<float>(file, NumberType::float32);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (!std::isfinite(values[n])) failAt(file, n);
  return values;
}

std::vector<std::int32_t> readFlipIntegers(const std::filesystem::path& file) {
  return valuesOf<std::int32_t>(file, NumberType::int32);
}

FlipBounds readFlipBounds(const std::filesystem::path& file) {
  const std::string content = contentOf(file);
  const nlohmann::json json = nlohmann::json::parse(content, nullptr, false);
  if (!json.is_object())
    fail(file,
         "is no JSON of one object; expected the numbers x, y, z, width, height, depth, dx, isize, jsize, "
         "ksize");
  const auto number = [&](const char* key) {
    const auto at = json.find(key);
    if (at == json.end() || !at->is_number() || !std::isfinite(at->get<double>()))
      fail(file, std::string("has no number '") + key + "'");
    return at->get<double>();
  };
  const auto size = [&](const char* key) {
    const double cells = number(key);
    if (!(cells >= 1.0 && cells <= 1e6))
      fail(file, std::string("'") + key + "' is no number of cells: 1 to 1,000,000");
    return static_cast<int>(cells);
  };
  FlipBounds bounds;
  bounds.min = {number("x"), number("y"), number("z")};
  bounds.size = {number("width"), number("height"), number("depth")};
  bounds.dx = number("dx");
  bounds.cells = {size("isize"), size("jsize"), size("ksize")};
  if (!(bounds.dx > 0.0)) fail(file, "'dx' is not above 0");
  return bounds;
}

}  // namespace fluidtex::caches
