#include "tools/ply.h"

#include "texture/exemplar/srgb.h"
#include "texture/shown/vector_maps.h"
#include "tools/atomic_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace fluidtex::tools {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY bytes are written as they lie in memory");

std::uint8_t toByte(float value) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
}

std::string header(const texture::TexturedSurface& surface) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment fluidtex, metres, Z up\n";
  text += "element vertex " + std::to_string(surface.positions.size()) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    text += std::string("property float ") + name + "\n";
  for (const char* name : {"red", "green", "blue", "alpha"})
    text += std::string("property uchar ") + name + "\n";
  for (const char* name : {"s", "t", "dx", "dy", "dz", "bx", "by", "bz", "vx", "vy", "vz", "trust", "age"})
    text += std::string("property float ") + name + "\n";
  text += "property uchar contact\n";
  for (const char* name : {"fade_s", "fade_t", "fade"}) text += std::string("property float ") + name + "\n";
  if (!surface.scale.empty()) text += "property float scale\n";
  for (const auto& [name, values] : surface.maps) text += "property float " + name + "\n";
  for (const auto& [name, values] : surface.vectors) {
    for (const std::string& part : texture::vectorNames(name)) text += "property float " + part + "\n";
  }
  text += "element face " + std::to_string(surface.triangles.size()) + "\n";
  text += "property list uchar int vertex_indices\nend_header\n";
  return text;
}

// Bytes put one after the other into memory of a size known before.
class Bytes {
 public:
  explicit Bytes(std::size_t size) : m_data(size) {}
  template <typename T>
  void put(const T& value) {
    std::memcpy(m_data.data() + m_used, &value, sizeof(T));
    m_used += sizeof(T);
  }
  void put(const texture::Vec3f& v) {
    put(v.x());
    put(v.y());
    put(v.z());
  }
  const std::vector<char>& data() const { return m_data; }

 private:
  std::vector<char> m_data;
  std::size_t m_used = 0;
};

// Of one vertex without further maps: 22 floats, 4 bytes of colour, 1 of contact. Of a face: its count, 3
// indices.
constexpr std::size_t kVertexBytes = 22 * 4 + 4 + 1, kFaceBytes = 1 + 3 * 4;

// Coordinate x in texels as a share of the exemplar's size. On a toroidal exemplar, x reaches up to the size:
// the half texel then leads over the edge, and it goes on at 0.
float share(float x, float size) {
  const float s = (x + 0.5f) / size;
  return s - std::floor(s);
}

}  // namespace

void writePly(const texture::TexturedSurface& surface, const std::filesystem::path& file) {
  const std::string head = header(surface);
  Bytes bytes(head.size() +
              surface.positions.size() * (kVertexBytes + (surface.scale.empty() ? 0 : 4) +
                                          4 * surface.maps.size() + 12 * surface.vectors.size()) +
              surface.triangles.size() * kFaceBytes);
  for (const char c : head) bytes.put(c);
  const float width = static_cast<float>(std::max(surface.exemplarWidth, 1));
  const float height = static_cast<float>(std::max(surface.exemplarHeight, 1));
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    bytes.put(surface.positions[v]);
    bytes.put(surface.normals[v]);
    const auto& color = surface.color[v];
    for (int c = 0; c < 3; ++c) bytes.put(toByte(texture::encodeSrgb(color[c])));
    bytes.put(toByte(color[3]));
    bytes.put(share(surface.coordinate[v].x(), width));
    bytes.put(share(surface.coordinate[v].y(), height));
    bytes.put(surface.orientation[v]);
    bytes.put(surface.previousPosition[v]);
    bytes.put(surface.velocity[v]);
    bytes.put(surface.trust[v]);
    bytes.put(surface.age[v]);
    bytes.put(surface.contact[v]);
    const float fade = surface.fading.weight.empty() ? 0.0f : surface.fading.weight[v];
    const texture::Vec2f former = fade > 0.0f ? surface.fading.coordinate[v] : surface.coordinate[v];
    bytes.put(share(former.x(), width));
    bytes.put(share(former.y(), height));
    bytes.put(fade);
    if (!surface.scale.empty()) bytes.put(surface.scale[v]);
    for (const auto& [name, values] : surface.maps) bytes.put(values[v]);
    for (const auto& [name, values] : surface.vectors) bytes.put(values[v]);
  }
  for (const auto& triangle : surface.triangles) {
    bytes.put(std::uint8_t{3});
    for (int c = 0; c < 3; ++c) bytes.put(static_cast<std::int32_t>(triangle[c]));
  }
  writeBytes(file, {bytes.data().data(), bytes.data().size()});
}

}  // namespace fluidtex::tools
