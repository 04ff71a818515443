#include "tools/formats/ply.h"

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

using texture::Vec2f;
using texture::Vec3f;

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
struct PlyColumn {
  std::vector<std::string> names;
  bool isFloat = true;
  std::function<void(std::size_t v, char* to)> put;  // writes all of them

  std::size_t bytes() const { return names.size() * (isFloat ? sizeof(float) : 1); }
};

template <typename T>
std::function<void(std::size_t, char*)> putting(const std::vector<T>& values) {
  return [&values](std::size_t v, char* to) { std::memcpy(to, &values[v], sizeof(T)); };
}

// All that is written of a vertex, in the file's order. Refers to its arguments.
std::vector<PlyColumn> plyColumnsOf(const texture::TexturedSurface& surface, const texture::Joints& joints) {
  const auto width = static_cast<float>(std::max(surface.exemplarWidth, 1)),
             height = static_cast<float>(std::max(surface.exemplarHeight, 1));
  const auto putShare = [=](const texture::Vec2f& texel, char* to) {
    const float st[2] = {share(texel.x(), width), share(texel.y(), height)};
    std::memcpy(to, st, sizeof st);
  };
  std::vector<PlyColumn> columns;
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
  const bool isFading = !fading.weight.empty(), isJoined = !joints.former.known.empty();
  columns.push_back({{"fade_s", "fade_t"}, true, [&, isFading, isJoined, putShare](std::size_t v, char* to) {
                       const bool fades = isFading && fading.weight[v] > 0.0f;
                       putShare(isJoined ? joints.former.places.coordinate[v]
                                : fades  ? fading.coordinate[v]
                                         : surface.coordinate[v],
                                to);
                     }});
  columns.push_back({{"fade"}, true, [&fading, isFading](std::size_t v, char* to) {
                       const float fade = isFading ? fading.weight[v] : 0.0f;
                       std::memcpy(to, &fade, sizeof fade);
                     }});
  const auto putGradient = [=](const std::vector<texture::TexelGradient>& gradient) {
    return [&gradient, width, height](std::size_t v, char* to) {
      const Vec3f st[2] = {gradient[v].s / width, gradient[v].t / height};
      std::memcpy(to, st, sizeof st);
    };
  };
  columns.push_back({{"sx", "sy", "sz", "tx", "ty", "tz"}, true, putGradient(surface.gradient)});
  columns.push_back({{"fade_sx", "fade_sy", "fade_sz", "fade_tx", "fade_ty", "fade_tz"},
                     true,
                     putGradient(isJoined   ? joints.former.places.gradient
                                 : isFading ? fading.gradient
                                            : surface.gradient)});
  if (!surface.scale.empty()) add({"scale"}, surface.scale);
  std::map<std::string, const std::vector<float>*> numbers;
  for (const auto& [name, values] : surface.maps) numbers[name] = &values;
  if (!surface.guidance.empty()) numbers["guidance"] = &surface.guidance;
  if (!surface.foam.empty()) numbers["foam"] = &surface.foam;
  for (const auto& [name, values] : numbers) add({name}, *values);
  for (const auto& [name, values] : surface.vectors) add(texture::vectorNames(name), values);
  return columns;
}

// Places at the corners, for each label: "s00 t00 s01 ...".
std::string jointProperties(const std::string& prefix) {
  std::string text;
  for (const char* label : {"0", "1", "2"})
    for (const char* corner : {"0", "1", "2"})
      for (const char* axis : {"s", "t"}) text += "property float " + prefix + axis + label + corner + "\n";
  return text;
}

std::string header(const texture::TexturedSurface& surface, const texture::Joints& joints,
                   const std::vector<PlyColumn>& columns) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment fluidtex, metres, Z up\n";
  text += "element vertex " + std::to_string(surface.positions.size()) + "\n";
  for (const PlyColumn& column : columns) {
    for (const std::string& name : column.names)
      text += std::string("property ") + (column.isFloat ? "float " : "uchar ") + name + "\n";
  }
  text += "element face " + std::to_string(surface.triangles.size()) + "\n";
  text += "property list uchar int vertex_indices\n";
  text += "element joint " + std::to_string(joints.joints.size()) + "\nproperty int face\n";
  return text + jointProperties("") + jointProperties("fade_") + "end_header\n";
}

}  // namespace

void writePly(const texture::TexturedSurface& surface, const texture::Joints& joints,
              const std::filesystem::path& file) {
  const std::vector<PlyColumn> columns = plyColumnsOf(surface, joints);
  const std::string head = header(surface, joints, columns);
  std::size_t stride = 0;
  for (const PlyColumn& column : columns) stride += column.bytes();
  constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::int32_t);  // a count, three indices
  constexpr std::size_t kJointBytes = sizeof(std::int32_t) + 2 * sizeof(texture::CornerPlaces);
  std::vector<char> bytes(head.size() + surface.positions.size() * stride +
                          surface.triangles.size() * kFaceBytes + joints.joints.size() * kJointBytes);
  char* to = std::copy(head.begin(), head.end(), bytes.data());
  for (const PlyColumn& column : columns) {
    for (std::size_t v = 0; v < surface.positions.size(); ++v) column.put(v, to + v * stride);
    to += column.bytes();
  }
  to = bytes.data() + head.size() + surface.positions.size() * stride;
  const auto putIndex = [&to](std::uint32_t number) {
    const auto index = static_cast<std::int32_t>(number);
    std::memcpy(to, &index, sizeof index);
    to += sizeof index;
  };
  for (const auto& triangle : surface.triangles) {
    *to++ = 3;
    for (int c = 0; c < 3; ++c) putIndex(triangle[c]);
  }
  const Vec2f size(static_cast<float>(std::max(surface.exemplarWidth, 1)),
                   static_cast<float>(std::max(surface.exemplarHeight, 1)));
  for (const texture::Joint& joint : joints.joints) {
    putIndex(joint.triangle);
    for (const texture::CornerPlaces* places : {&joint.shown, &joint.former})
      for (const auto& label : *places)
        for (const Vec2f& place : label) {
          const Vec2f st = (place + Vec2f(0.5f, 0.5f)) / size;
          std::memcpy(to, &st, sizeof st);
          to += sizeof st;
        }
  }
  writeBytes(file, {bytes.data(), bytes.size()});
}

}  // namespace fluidtex::tools
