#include "texture/labels/slips.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;
using fluidtex::randomUnit;

namespace {

const Float8 kAllChannels{1, 1, 1, 1, 1, 1, 1, 1};

bool inside(const Vec3f& x) {
  return x.z() > 1.9f && x.x() > 2 && x.x() < 30 && x.y() > 2 && x.y() < 30;
}

// On the upper side of a flat box of 32 pixels the picture texel = (40 + x, 60 - y), moved by `slip` beyond
// the middle.
Labels slipped(const OrientedMesh& surface, const Vec2f& slip) {
  Labels labels;
  for (const Vec3f& x : surface.mesh.positions)
    labels.push_back(
        unstretched(Vec2f(40, 60) + Vec2f(x.x(), -x.y()) + (x.x() > 16 ? slip : Vec2f(0, 0)), {}));
  return labels;
}

// The most that an edge inside is drawn out or squeezed, and the most that a label's texel lies from what is
// expected.
struct Found {
  float edge = 0.0f, stretch = 1.0f, moved = 0.0f;
};

Found judged(const OrientedMesh& surface, const TexelImage& image, const Labels& labels,
             const Labels& before) {
  Found found;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (!inside(surface.mesh.positions[v])) continue;
    found.stretch = std::max(found.stretch, stretch(labels[v]));
    found.moved = std::max(found.moved, texelDifference(image, labels[v].texel, before[v].texel).length());
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h) {
      const Label straight = unstretched(labels[v].texel, {});
      const Label& other = labels[surface.graph.neighbor[h]];
      if (!inside(surface.mesh.positions[surface.graph.neighbor[h]])) continue;
      found.edge = std::max(
          found.edge, texelDifference(image, other.texel, straight.at(surface.connection.edge[h])).length());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("slips: half a texel is spread over many edges, and gradients say what is left") {
  const OrientedMesh surface = flatBox(32);
  const TexelImage image = makeTexelImage(noiseImage(120, 120, 3, 1), true, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const Labels before = slipped(surface, {0.5f, -0.3f});
  Labels labels = before;
  closeSlips(model, {}, labels);
  const Found was = judged(surface, image, before, before), is = judged(surface, image, labels, before);
  CHECK(was.edge > 0.55f);
  CHECK(is.edge < 0.15f);
  CHECK(is.moved < 0.4f);  // about half of it to each side
  CHECK(is.stretch > 1.02f);
  CHECK(is.stretch < 1.15f);
  // Gradients put neighbours where they are.
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (!inside(surface.mesh.positions[v])) continue;
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h)
      if (inside(surface.mesh.positions[surface.graph.neighbor[h]]))
        CHECK(texelDifference(image, labels[surface.graph.neighbor[h]].texel,
                              labels[v].at(surface.connection.edge[h]))
                  .length() < 0.1f);
  }
}

TEST_CASE("slips: joints of more than a texel, and what is not free, stay as they are") {
  const OrientedMesh surface = flatBox(32);
  const TexelImage image = makeTexelImage(noiseImage(120, 120, 3, 1), true, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const Labels joint = slipped(surface, {1.0f, 0.0f});
  std::vector<std::uint8_t> top;
  for (const Vec3f& x : surface.mesh.positions) top.push_back(inside(x));
  Labels labels = joint;
  closeSlips(model, top, labels);
  CHECK(judged(surface, image, labels, joint).moved < 1e-3f);

  const Labels before = slipped(surface, {0.6f, 0.0f});
  std::vector<std::uint8_t> free;
  for (const Vec3f& x : surface.mesh.positions) free.push_back(x.x() > 16 && inside(x));
  labels = before;
  closeSlips(model, free, labels);
  const Found found = judged(surface, image, labels, before);
  CHECK(found.edge < 0.36f);
  CHECK(found.moved > 0.3f);  // all of it on the free side
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (!free[v]) CHECK(labels[v].texel == before[v].texel);
}

TEST_CASE("slips: texture without any stays where it is, drawn out or not") {
  const OrientedMesh surface = flatBox(32);
  const TexelImage image = makeTexelImage(noiseImage(120, 120, 3, 1), true, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  Labels before;
  for (const Vec3f& x : surface.mesh.positions)
    before.push_back({{40 + 0.7f * x.x(), 60 - x.y()}, {0.7f, 0, 0, 1}});
  std::vector<std::uint8_t> free;
  for (const Vec3f& x : surface.mesh.positions) free.push_back(inside(x));
  Labels labels = before;
  closeSlips(model, free, labels);
  const Found found = judged(surface, image, labels, before);
  CHECK(found.moved < 1e-3f);
  CHECK(found.stretch == Approx(1 / 0.7f).epsilon(1e-3));
}

TEST_CASE("slips: whatever the vertices' axes, across the exemplar's edges, on any number of threads") {
  const bool toroidal = GENERATE(true, false);
  SurfaceMesh mesh = boxMesh({0, 0, 0}, {32, 32, 2}, {32, 32, 2});
  mesh.spacing = 1.0;
  mesh.orientation = referenceVectors(mesh.normals);
  std::vector<std::uint8_t> free;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& x = mesh.positions[v];
    free.push_back(inside(x));
    const float angle = 0.1f * x.x() + 6.0f * float(randomUnit(7, v));
    if (x.z() > 1.9f && x.x() > 0.5f && x.x() < 31.5f && x.y() > 0.5f && x.y() < 31.5f)
      mesh.orientation[v] = Vec3f(std::cos(angle), std::sin(angle), 0.0f);
  }
  const OrientedMesh surface = orientedMesh(std::move(mesh));
  const TexelImage image = makeTexelImage(noiseImage(48, 48, 3, 1), toroidal, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  // The picture's edges cross the box where it wraps, and lie just outside it where it does not.
  const Vec2f corner = toroidal ? Vec2f(30, 20) : Vec2f(8, 40);
  Labels before;
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    const Vec3f &x = surface.mesh.positions[v], &d = surface.mesh.orientation[v];
    const Vec2f slip = x.x() > 16 ? Vec2f(0.4f, 0.3f) : Vec2f(0, 0);
    before.push_back(
        unstretched(image.brought(corner + Vec2f(x.x(), -x.y()) + slip), {Complexf(d.x(), -d.y())}));
  }
  Labels result[2] = {before, before};
  for (int i = 0; i < 2; ++i) {
    onThreads(i == 0 ? 1 : 4, [&] { closeSlips(model, free, result[i]); });
  }
  for (std::uint32_t v = 0; v < before.size(); ++v) {
    CHECK(result[0][v].texel == result[1][v].texel);
    CHECK(result[0][v].jacobian == result[1][v].jacobian);
    if (!inside(surface.mesh.positions[v])) continue;
    CHECK(texelDifference(image, result[0][v].texel, before[v].texel).length() < 0.35f);
    CHECK(stretch(result[0][v]) < 1.2f);
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h) {
      const std::uint32_t u = surface.graph.neighbor[h];
      if (!inside(surface.mesh.positions[u])) continue;
      const Vec2f there = result[0][v].at(surface.connection.edge[h]);
      CHECK(texelDifference(image, result[0][u].texel, there).length() < 0.12f);
    }
  }
}
