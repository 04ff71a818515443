#include "tools/output/ply.h"

#include "texture/exemplar/srgb.h"
#include "texture/shown/vector_maps.h"
#include "tools/base/atomic_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace fluidtex::tools {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY bytes are written as they lie in memory");

std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

// Coordinate x in texels as a share of the exemplar's size. On a toroidal exemplar, x reaches up to the size:
// the half texel then leads over the edge, and it goes on at 0.
float share(float x, float size) {
  const float s = (x + 0.5f) / size;
  return s - std::floor(s);
}

// Properties of a vertex that follow one another, all of one type.
struct Column {
  std::vector<std::string> names;
  bool isFloat = true;
  std::function<void(std::size_t v, char* to)> put;  // writes all of them

  std::size_t bytes() const { return names.size() * (isFloat ? sizeof(float) : 1); }
};

template <typename T>
std::function<void(std::size_t, char*)> putting(const std::vector<T>& values) {
  return [&values](std::size_t v, char* to) { std::memcpy(to, &values[v], sizeof(T)); };
}

// All that is written of a vertex, in the file's order. Refers to the surface.
std::vector<Column> columnsOf(const texture::TexturedSurface& surface) {
  const auto width = static_cast<float>(std::max(surface.exemplarWidth, 1)),
             height = static_cast<float>(std::max(surface.exemplarHeight, 1));
  const auto putShare = [=](const texture::Vec2f& texel, char* to) {
    const float st[2] = {share(texel.x(), width), share(texel.y(), height)};
    std::memcpy(to, st, sizeof st);
  };
  std::vector<Column> columns;
  const auto add = [&](std::vector<std::string> names, const auto& values) {
    constexpr bool kBytes = sizeof(values[0]) == 1;
    columns.push_back({std::move(names), !kBytes, putting(values)});
  };
  add({"x", "y", "z"}, surface.positions);
  add({"nx", "ny", "nz"}, surface.normals);
  columns.push_back({{"red", "green", "blue", "alpha"}, false, [&surface](std::size_t v, char* to) {
                       const texture::Vec4f& color = surface.color[v];
                       for (int c = 0; c < 3; ++c) to[c] = char(toByte(texture::encodeSrgb(color[c])));
                       to[3] = char(toByte(color[3]));
                     }});
  columns.push_back({{"s", "t"}, true, [&surface, putShare](std::size_t v, char* to) {
                       putShare(surface.coordinate[v], to);
                     }});
  add({"dx", "dy", "dz"}, surface.orientation);
  add({"bx", "by", "bz"}, surface.previousPosition);
  add({"vx", "vy", "vz"}, surface.velocity);
  add({"trust"}, surface.trust);
  add({"age"}, surface.age);
  add({"contact"}, surface.contact);
  const texture::Fading& fading = surface.fading;
  columns.push_back({{"fade_s", "fade_t"}, true, [&, putShare](std::size_t v, char* to) {
                       const bool fades = !fading.weight.empty() && fading.weight[v] > 0.0f;
                       putShare(fades ? fading.coordinate[v] : surface.coordinate[v], to);
                     }});
  columns.push_back({{"fade"}, true, [&fading](std::size_t v, char* to) {
                       const float fade = fading.weight.empty() ? 0.0f : fading.weight[v];
                       std::memcpy(to, &fade, sizeof fade);
                     }});
  if (!surface.scale.empty()) add({"scale"}, surface.scale);
  std::map<std::string, const std::vector<float>*> numbers;
  for (const auto& [name, values] : surface.maps) numbers[name] = &values;
  if (!surface.guidance.empty()) numbers["guidance"] = &surface.guidance;
  if (!surface.foam.empty()) numbers["foam"] = &surface.foam;
  for (const auto& [name, values] : numbers) add({name}, *values);
  for (const auto& [name, values] : surface.vectors) add(texture::vectorNames(name), values);
  return columns;
}

std::string header(const texture::TexturedSurface& surface, const std::vector<Column>& columns) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment fluidtex, metres, Z up\n";
  text += "element vertex " + std::to_string(surface.positions.size()) + "\n";
  for (const Column& column : columns) {
    for (const std::string& name : column.names)
      text += std::string("property ") + (column.isFloat ? "float " : "uchar ") + name + "\n";
  }
  text += "element face " + std::to_string(surface.triangles.size()) + "\n";
  text += "property list uchar int vertex_indices\nend_header\n";
  return text;
}

}  // namespace

void writePly(const texture::TexturedSurface& surface, const std::filesystem::path& file) {
  const std::vector<Column> columns = columnsOf(surface);
  const std::string head = header(surface, columns);
  std::size_t stride = 0;
  for (const Column& column : columns) stride += column.bytes();
  constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::int32_t);  // a count, three indices
  std::vector<char> bytes(head.size() + surface.positions.size() * stride +
                          surface.triangles.size() * kFaceBytes);
  char* to = std::copy(head.begin(), head.end(), bytes.data());
  for (const Column& column : columns) {
    for (std::size_t v = 0; v < surface.positions.size(); ++v) column.put(v, to + v * stride);
    to += column.bytes();
  }
  to = bytes.data() + head.size() + surface.positions.size() * stride;
  for (const auto& triangle : surface.triangles) {
    *to++ = 3;
    for (int c = 0; c < 3; ++c, to += sizeof(std::int32_t)) {
      const auto index = static_cast<std::int32_t>(triangle[c]);
      std::memcpy(to, &index, sizeof index);
    }
  }
  writeBytes(file, {bytes.data(), bytes.size()});
}

}  // namespace fluidtex::tools
