#include "texture/fresh_start.h"

#include "tests/texture/oriented_mesh.h"
#include "tests/texture/test_images.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// The upper side of a flat box of 60 pixels, texture magnified twofold on it.
Labels magnified(const OrientedMesh& surface) {
  Labels labels;
  for (const Vec3f& x : surface.mesh.positions)
    labels.push_back({{100 + 0.5f * x.x(), 100 - 0.5f * x.y()}, {0.5f, 0, 0, 0.5f}});
  return labels;
}

Disc discAround(const OrientedMesh& surface, const Vec3f& center, float reach, float growth) {
  Disc disc;
  disc.center = nearestVertex(surface.mesh, center);
  disc.growth = growth;
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    if (x.z() > 1.9f && (x - center).length() <= reach) disc.members.push_back(v);
  }
  return disc;
}

}  // namespace

TEST_CASE(
    "fresh start: grown discs get unstretched texture in one piece, the members beyond them too, nothing "
    "else does") {
  const OrientedMesh surface = flatBox(60);
  const TexelImage image = makeTexelImage(noiseImage(200, 200, 3, 1), false, 4);
  const Labels before = magnified(surface);
  // Of radius 10 discs reach 8; the second one has members beyond. The third one has not grown.
  const std::vector<Disc> discs{discAround(surface, {15, 15, 2}, 8.0f, 4.0f),
                                discAround(surface, {40, 40, 2}, 14.0f, 4.0f),
                                discAround(surface, {15, 45, 2}, 8.0f, 1.0f)};
  Labels labels = before;
  startAfresh(surface.view(), image, discs, 10.0, lookUp(image, before), 7, labels);
  std::vector<int> member(labels.size(), -1);
  for (int d = 0; d < 2; ++d)
    for (const std::uint32_t v : discs[std::size_t(d)].members) member[v] = d;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (member[v] < 0) {
      CHECK(labels[v].texel == before[v].texel);
      continue;
    }
    CHECK(stretch(labels[v]) < 1.01f);
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h) {
      const std::uint32_t u = surface.graph.neighbor[h];
      if (member[u] != member[v]) continue;
      CHECK((labels[v].at(surface.connection.edge[h]) - labels[u].texel).length() < 0.02f);
    }
  }
}

TEST_CASE("labels: handed on ring by ring, as far as is wanted") {
  const OrientedMesh surface = flatBox(40);
  const TexelImage image = makeTexelImage(noiseImage(200, 200, 3, 1), false, 4);
  const auto right = [](const Vec3f& x) { return Vec2f(80 + x.x(), 120 - x.y()); };
  Labels labels(surface.mesh.positions.size());
  std::vector<std::uint8_t> placed, wanted;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    const bool inside = x.z() > 1.9f && x.x() > 2 && x.x() < 38 && x.y() > 2 && x.y() < 38;
    placed.push_back(inside && x.x() < 10);
    wanted.push_back(inside && x.x() < 30);
    if (placed[v]) labels[v] = unstretched(right(x), Complexf(1.0f));
  }
  handOn(image, surface.view(), wanted, placed, labels);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const Vec2f expected = wanted[v] ? right(surface.mesh.positions[v]) : Vec2f(0.0f, 0.0f);
    CHECK((labels[v].texel - expected).length() < 1e-3f);
  }
}
