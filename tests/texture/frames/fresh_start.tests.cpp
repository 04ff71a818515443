#include "texture/frames/fresh_start.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "texture/labels/ways.h"

#include <catch2/catch.hpp>

#include <set>

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

Disc discAround(const OrientedMesh& surface, const Vec3f& center, float reach) {
  Disc disc;
  disc.center = nearestVertex(surface.mesh, center);
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    if (x.z() > 1.9f && (x - center).length() <= reach) disc.members.push_back(v);
  }
  return disc;
}

}  // namespace

TEST_CASE(
    "fresh start: discs get unstretched texture in one piece, the members beyond them too, nothing else "
    "does") {
  const OrientedMesh surface = flatBox(60);
  const TexelImage image = makeTexelImage(noiseImage(200, 200, 3, 1), false, 4);
  const Labels before = magnified(surface);
  // Of radius 10 discs reach 8; the second one has members beyond.
  const std::vector<Disc> discs{discAround(surface, {15, 15, 2}, 8.0f),
                                discAround(surface, {40, 40, 2}, 14.0f)};
  Labels labels = before;
  startAfresh(surface.view(), image, discs, 10.0, lookUp(image, before), 7, labels);
  std::vector<int> member(labels.size(), -1);
  for (std::size_t d = 0; d < discs.size(); ++d)
    for (const std::uint32_t v : discs[d].members) member[v] = int(d);
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

TEST_CASE("fresh start: blocks lie in all ways that the exemplar may") {
  const OrientedMesh surface = flatBox(120);
  TexelImage image = makeTexelImage(noiseImage(200, 200, 3, 1), true, 4);
  std::vector<Disc> discs;
  for (float x = 12; x < 120; x += 19)
    for (float y = 12; y < 120; y += 19) discs.push_back(discAround(surface, {x, y, 2}, 8.0f));
  for (const Ways& ways : {Ways{1}, Ways{2, true}}) {
    image.ways = ways;
    Labels labels = magnified(surface);
    startAfresh(surface.view(), image, discs, 10.0, lookUp(image, labels), 7, labels);
    std::set<Way> found;
    for (const Disc& disc : discs) {
      const Way way = nearestWay({4, true}, layOf(labels[disc.center], {4, true}));
      found.insert(way);
      for (const std::uint32_t v : disc.members) {
        const Vec3f l = surface.mesh.positions[v] - surface.mesh.positions[disc.center];
        const Vec2f expected = labels[disc.center].texel + laid(way, Vec2f(l.x(), -l.y()));
        CHECK(texelDifference(image, labels[v].texel, expected).length() < 0.02f);
      }
    }
    CHECK(found == (ways.mirrored ? std::set<Way>{0, 2, kMirrored, kMirrored + 2} : std::set<Way>{0}));
  }
}

TEST_CASE("fresh start: what has little contrast is not preferred") {
  const OrientedMesh surface = flatBox(120);
  Image picture = noiseImage(200, 200, 3, 1);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 100; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 0.5f + 0.1f * (picture.at(x, y)[c] - 0.5f);
  const TexelImage image = makeTexelImage(picture, false, 4);
  std::vector<Disc> discs;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      discs.push_back(discAround(surface, {20.0f + 20.0f * float(i), 20.0f + 20.0f * float(j), 2.0f}, 8.0f));
  Labels labels = magnified(surface);
  startAfresh(surface.view(), image, discs, 10.0, lookUp(image, magnified(surface)), 7, labels);
  int flat = 0;
  for (const Disc& disc : discs) flat += labels[disc.center].texel[0] < 100.0f;
  CHECK(flat > 5);
  CHECK(flat < 20);
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
    if (placed[v]) labels[v] = unstretched(right(x), {});
  }
  handOn(image, surface.view(), wanted, placed, labels);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const Vec2f expected = wanted[v] ? right(surface.mesh.positions[v]) : Vec2f(0.0f, 0.0f);
    CHECK((labels[v].texel - expected).length() < 1e-3f);
  }
}
