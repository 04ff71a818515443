#include "tools/report/packed_mesh.h"
#include "tests/tools/formats/sample_surface.h"

#include <meshoptimizer.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <vector>

using namespace fluidtex;
using namespace fluidtex::tools;

namespace {

// As the page reads it (tools/report/page/packed_mesh.js).
struct Unpacked {
  std::uint32_t counts[4];
  float low[3], step, mostAge, mostSpeed;
  std::vector<unsigned char> vertices;  // 16 each
  std::vector<unsigned> indices;
  texture::Vec3f position(std::size_t v) const {
    std::uint16_t xyz[3];
    std::memcpy(xyz, &vertices[16 * v], sizeof xyz);
    return {low[0] + step * float(xyz[0]), low[1] + step * float(xyz[1]), low[2] + step * float(xyz[2])};
  }
};

Unpacked unpack(const std::string& packed) {
  Unpacked u;
  const auto* bytes = reinterpret_cast<const unsigned char*>(packed.data());
  std::memcpy(u.counts, bytes, 16);
  std::memcpy(u.low, bytes + 16, 24);
  REQUIRE(packed.size() == 40 + u.counts[2] + u.counts[3]);
  u.vertices.resize(16 * u.counts[0]);
  u.indices.resize(u.counts[1]);
  REQUIRE(meshopt_decodeVertexBuffer(u.vertices.data(), u.counts[0], 16, bytes + 40, u.counts[2]) == 0);
  REQUIRE(meshopt_decodeIndexBuffer(u.indices.data(), u.counts[1], bytes + 40 + u.counts[2], u.counts[3]) ==
          0);
  return u;
}

// A torus of m x n vertices.
texture::TexturedSurface torus(int m, int n) {
  texture::TexturedSurface s;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < n; ++j) {
      const double a = 2.0 * M_PI * i / m, b = 2.0 * M_PI * j / n;
      s.positions.emplace_back(texture::Vec3f(
          openvdb::Vec3d((2.0 + std::cos(b)) * std::cos(a), (2.0 + std::cos(b)) * std::sin(a), std::sin(b))));
      s.color.emplace_back(0.5f, 0.5f, 0.5f, 1.0f);
      const auto at = [&](int k, int l) { return std::uint32_t((k % m) * n + l % n); };
      s.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      s.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return s;
}

}  // namespace

TEST_CASE("packed mesh: positions to half a step, colours as bytes, the same triangles", "[tools]") {
  const texture::TexturedSurface surface = sampleSurface();
  const Unpacked u = unpack(packMesh(surface, 1000));
  REQUIRE(u.counts[0] == 4);
  REQUIRE(u.counts[1] == 12);
  CHECK(u.step == Approx(1.0 / 65535.0));
  CHECK(u.mostAge == Approx(0.3));
  CHECK(u.mostSpeed == Approx(std::sqrt(18.0)));
  // Which vertex is which, by its place.
  std::map<std::uint32_t, std::uint32_t> original;
  for (std::uint32_t v = 0; v < 4; ++v)
    for (std::uint32_t w = 0; w < 4; ++w)
      if ((u.position(v) - surface.positions[w]).length() <= u.step) original[v] = w;
  REQUIRE(original.size() == 4);
  for (const auto& [v, w] : original) {
    CHECK(int(u.vertices[16 * v + 8]) == 188);  // sRGB of 0.5
    CHECK(int(u.vertices[16 * v + 11]) == 64);
    CHECK(int(u.vertices[16 * v + 12]) == std::lround(255.0 * w / 3.0));
    CHECK(int(u.vertices[16 * v + 13]) == std::lround(255.0 * 0.2 * w));
    CHECK(int(u.vertices[16 * v + 14]) == std::lround(255.0 * w / 3.0));
  }
  const auto turned = [](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return std::min({std::vector{a, b, c}, std::vector{b, c, a}, std::vector{c, a, b}});
  };
  std::set<std::vector<std::uint32_t>> before, after;
  for (const texture::Vec3I& t : surface.triangles) before.insert(turned(t[0], t[1], t[2]));
  for (std::size_t n = 0; n < u.indices.size(); n += 3)
    after.insert(turned(original[u.indices[n]], original[u.indices[n + 1]], original[u.indices[n + 2]]));
  CHECK(after == before);
}

TEST_CASE("packed mesh: one that is too large is thinned and keeps its shape", "[tools]") {
  const texture::TexturedSurface surface = torus(200, 100);
  REQUIRE(surface.triangles.size() == 40'000);
  CHECK(unpack(packMesh(surface, 40'000)).counts[1] == 120'000);
  const Unpacked thin = unpack(packMesh(surface, 10'000));
  CHECK(thin.counts[1] / 3 <= 10'000);
  CHECK(thin.counts[1] / 3 > 9'000);
  CHECK(thin.counts[0] < 6'000);
  double volume = 0.0;
  for (std::size_t n = 0; n < thin.indices.size(); n += 3)
    volume += thin.position(thin.indices[n])
                  .dot(thin.position(thin.indices[n + 1]).cross(thin.position(thin.indices[n + 2]))) /
              6.0;
  CHECK(volume == Approx(4.0 * M_PI * M_PI).epsilon(0.01));
}

TEST_CASE("packed mesh: few bytes a vertex", "[tools]") {
  CHECK(packMesh(torus(200, 100), 100'000).size() < 20'000 * 16);
}

TEST_CASE("packed mesh: no surface, and values that are no numbers", "[tools]") {
  CHECK(unpack(packMesh({}, 1000)).counts[0] == 0);
  texture::TexturedSurface surface = sampleSurface();
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  surface.age = {nan, infinity, 1.0f, 0.5f};
  surface.color[0][0] = nan;
  surface.positions[3] = {nan, infinity, -infinity};
  const Unpacked u = unpack(packMesh(surface, 1000));
  CHECK(u.mostAge == 1.0f);
  for (std::uint32_t v = 0; v < u.counts[0]; ++v) CHECK(std::isfinite(u.position(v).length()));
}
