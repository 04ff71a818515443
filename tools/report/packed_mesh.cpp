#include "tools/report/packed_mesh.h"

#include "texture/exemplar/srgb.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace fluidtex::tools {
namespace {

static_assert(std::endian::native == std::endian::little, "bytes are written as they lie in memory");

struct Vertex {
  std::uint16_t x = 0, y = 0, z = 0, unused = 0;
  std::uint8_t red = 0, green = 0, blue = 0, alpha = 0;
  std::uint8_t age = 0, trust = 0, speed = 0, zero = 0;
};
static_assert(sizeof(Vertex) == 16);

struct Head {
  std::uint32_t vertices = 0, indices = 0, vertexBytes = 0, indexBytes = 0;
  std::array<float, 3> low{};
  float step = 0.0f, mostAge = 0.0f, mostSpeed = 0.0f;
};
static_assert(sizeof(Head) == 40);

// value / most, 0 where that is no number.
template <typename T>
T quantized(float value, float most) {
  constexpr float kMost = static_cast<float>(std::numeric_limits<T>::max());
  const float share = most > 0.0f ? value / most : 0.0f;
  return std::isnan(share) ? T{0} : static_cast<T>(std::lround(kMost * std::clamp(share, 0.0f, 1.0f)));
}

float most(const std::vector<float>& values) {
  float found = 0.0f;
  for (const float value : values)
    if (std::isfinite(value)) found = std::max(found, value);
  return found;
}

std::vector<float> lengths(const std::vector<texture::Vec3f>& vectors) {
  std::vector<float> found;
  found.reserve(vectors.size());
  for (const texture::Vec3f& v : vectors) found.push_back(v.length());
  return found;
}

float valueAt(const std::vector<float>& values, std::size_t v) {
  return v < values.size() ? values[v] : 0.0f;
}

std::vector<Vertex> verticesOf(const texture::TexturedSurface& surface, Head& head) {
  openvdb::BBoxd bounds;
  for (const texture::Vec3f& p : surface.positions)
    if (std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z()))
      bounds.expand(openvdb::Vec3d(p));
  if (!bounds.empty()) {
    for (int c = 0; c < 3; ++c) head.low[std::size_t(c)] = static_cast<float>(bounds.min()[c]);
    const openvdb::Vec3d extents = bounds.extents();
    head.step = static_cast<float>(std::max({extents.x(), extents.y(), extents.z()}) / 65535.0);
  }
  const std::vector<float> speed = lengths(surface.velocity);
  head.mostAge = most(surface.age);
  head.mostSpeed = most(speed);
  std::vector<Vertex> vertices(surface.positions.size());
  const float reach = 65535.0f * head.step;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    Vertex& vertex = vertices[v];
    const texture::Vec3f& p = surface.positions[v];
    vertex.x = quantized<std::uint16_t>(p.x() - head.low[0], reach);
    vertex.y = quantized<std::uint16_t>(p.y() - head.low[1], reach);
    vertex.z = quantized<std::uint16_t>(p.z() - head.low[2], reach);
    const texture::Vec4f color = v < surface.color.size() ? surface.color[v] : texture::Vec4f(1.0f);
    vertex.red = quantized<std::uint8_t>(texture::encodeSrgb(color[0]), 1.0f);
    vertex.green = quantized<std::uint8_t>(texture::encodeSrgb(color[1]), 1.0f);
    vertex.blue = quantized<std::uint8_t>(texture::encodeSrgb(color[2]), 1.0f);
    vertex.alpha = quantized<std::uint8_t>(color[3], 1.0f);
    vertex.age = quantized<std::uint8_t>(valueAt(surface.age, v), head.mostAge);
    vertex.trust = quantized<std::uint8_t>(valueAt(surface.trust, v), 1.0f);
    vertex.speed = quantized<std::uint8_t>(valueAt(speed, v), head.mostSpeed);
  }
  return vertices;
}

std::vector<unsigned> indicesOf(const texture::TexturedSurface& surface, std::size_t mostTriangles) {
  std::vector<unsigned> indices;
  for (const texture::Vec3I& t : surface.triangles) indices.insert(indices.end(), {t[0], t[1], t[2]});
  if (surface.triangles.size() <= mostTriangles) return indices;
  constexpr float kAnyError = 1.0f;  // of the mesh's extent
  std::vector<unsigned> fewer(indices.size());
  fewer.resize(meshopt_simplify(fewer.data(), indices.data(), indices.size(),
                                surface.positions.front().asPointer(), surface.positions.size(),
                                sizeof(texture::Vec3f), 3 * mostTriangles, kAnyError, 0, nullptr));
  return fewer;
}

}  // namespace

std::string packMesh(const texture::TexturedSurface& surface, std::size_t mostTriangles) {
  Head head;
  std::vector<Vertex> vertices = verticesOf(surface, head);
  std::vector<unsigned> indices = indicesOf(surface, mostTriangles);
  // In an order in which neighbours follow one another; what no triangle uses falls away.
  meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), vertices.size());
  vertices.resize(meshopt_optimizeVertexFetch(vertices.data(), indices.data(), indices.size(),
                                              vertices.data(), vertices.size(), sizeof(Vertex)));
  std::string coded(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(Vertex)), '\0');
  coded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(coded.data()), coded.size(),
                                          vertices.data(), vertices.size(), sizeof(Vertex)));
  std::string codedIndices(meshopt_encodeIndexBufferBound(indices.size(), vertices.size()), '\0');
  codedIndices.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(codedIndices.data()),
                                                codedIndices.size(), indices.data(), indices.size()));
  head.vertices = static_cast<std::uint32_t>(vertices.size());
  head.indices = static_cast<std::uint32_t>(indices.size());
  head.vertexBytes = static_cast<std::uint32_t>(coded.size());
  head.indexBytes = static_cast<std::uint32_t>(codedIndices.size());
  std::string packed(sizeof head, '\0');
  std::memcpy(packed.data(), &head, sizeof head);
  return packed + coded + codedIndices;
}

}  // namespace fluidtex::tools
