#include "texture/labels/chips.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;

namespace {

struct Plane {
  OrientedMesh surface = flatBox(24);
  TexelImage image = makeTexelImage(blobImage(100, 100, 3, 10.0, 1), false, 4);
  SeamModel model = makeSeamModel(surface.view(), image, Float8{1, 1, 1, 1, 1, 1, 1, 1});
  std::size_t count = surface.mesh.positions.size();

  // The upper side, but for its rim.
  std::vector<std::uint8_t> top() const {
    std::vector<std::uint8_t> result;
    for (const Vec3f& x : surface.mesh.positions)
      result.push_back(x.z() > 1.9f && x.x() > 2 && x.x() < 22 && x.y() > 2 && x.y() < 22);
    return result;
  }
  // Of the upper side, within `radius` of its middle.
  std::vector<std::uint8_t> middle(float radius) const {
    std::vector<std::uint8_t> result;
    for (const Vec3f& x : surface.mesh.positions)
      result.push_back(x.z() > 1.9f && (x - Vec3f(12, 12, 2)).length() < radius);
    return result;
  }
  // One picture, and another in the place of it where `other` is set.
  Labels pictures(const std::vector<std::uint8_t>& other) const {
    Labels labels;
    for (std::uint32_t v = 0; v < count; ++v) {
      const Vec3f& x = surface.mesh.positions[v];
      labels.push_back({Vec2f(20 + x.x(), 60 - x.y()) + Vec2f(other[v] ? 30.0f : 0.0f, 0), {1, 0, 0, 1}});
    }
    return labels;
  }
};

}  // namespace

TEST_CASE("chips: a small piece joins what is around it, a large one stays") {
  const Plane plane;
  const Labels whole = plane.pictures(plane.middle(0.0f));
  for (const float radius : {0.5f, 1.5f, 2.5f}) {  // 1, 9 and 21 vertices
    const std::vector<std::uint8_t> chip = plane.middle(radius);
    Labels labels = plane.pictures(chip);
    absorbChips(plane.model, plane.top(), labels);
    for (std::uint32_t v = 0; v < plane.count; ++v)
      CHECK((labels[v].texel - whole[v].texel).length() < 1e-3f);
  }
  const std::vector<std::uint8_t> piece = plane.middle(4.0f);
  const Labels before = plane.pictures(piece);
  Labels labels = before;
  absorbChips(plane.model, plane.top(), labels);
  for (std::uint32_t v = 0; v < plane.count; ++v) CHECK(labels[v].texel == before[v].texel);
}

TEST_CASE("chips: 24 vertices are one, 25 are none") {
  const Plane plane;
  for (const int size : {24, 25}) {
    std::vector<std::uint8_t> piece(plane.count, 0);
    for (std::uint32_t v = 0; v < plane.count; ++v) {
      const Vec3f& x = plane.surface.mesh.positions[v];
      const int column = int(std::lround(x.x())) - 10, row = int(std::lround(x.y())) - 10;
      piece[v] = x.z() > 1.9f && column >= 0 && column < 5 && row >= 0 && row < 5 && 5 * row + column < size;
    }
    Labels labels = plane.pictures(piece);
    absorbChips(plane.model, plane.top(), labels);
    const Labels expected = plane.pictures(size == 24 ? plane.middle(0.0f) : piece);
    for (std::uint32_t v = 0; v < plane.count; ++v)
      CHECK((labels[v].texel - expected[v].texel).length() < 1e-3f);
  }
}

TEST_CASE("chips: where nothing is around, or beyond the exemplar's edge, they stay") {
  const Plane plane;
  // Every vertex of the free part lies elsewhere in the exemplar than its neighbours: all are chips.
  Labels scattered;
  for (std::uint32_t v = 0; v < plane.count; ++v)
    scattered.push_back({Vec2f(float(v * 37 % 97), float(v * 61 % 97)), {1, 0, 0, 1}});
  Labels labels = scattered;
  absorbChips(plane.model, std::vector<std::uint8_t>(plane.count, 1), labels);
  for (std::uint32_t v = 0; v < plane.count; ++v) CHECK(labels[v].texel == scattered[v].texel);

  // Around the chip the picture ends: columns run out of the exemplar at x = 12.
  const std::vector<std::uint8_t> chip = plane.middle(2.5f);
  labels = plane.pictures(chip);
  for (std::uint32_t v = 0; v < plane.count; ++v)
    if (!chip[v]) labels[v].texel[0] = 87.0f + plane.surface.mesh.positions[v].x();
  const Labels before = labels;
  absorbChips(plane.model, plane.top(), labels);
  for (std::uint32_t v = 0; v < plane.count; ++v) {
    const float x = plane.surface.mesh.positions[v].x();
    if (!chip[v]) continue;
    if (x < 12.5f) CHECK(std::abs(labels[v].texel[0] - (87.0f + x)) < 1e-3f);
    if (x > 12.5f) CHECK(labels[v].texel == before[v].texel);
  }
}

TEST_CASE("chips: what is not free keeps its label, and the chip that it belongs to as well") {
  const Plane plane;
  const Labels before = plane.pictures(plane.middle(2.5f));
  std::vector<std::uint8_t> free = plane.top();
  for (std::uint32_t v = 0; v < plane.count; ++v)
    if ((plane.surface.mesh.positions[v] - Vec3f(12, 13, 2)).length() < 0.5f) free[v] = 0;
  Labels labels = before;
  absorbChips(plane.model, free, labels);
  for (std::uint32_t v = 0; v < plane.count; ++v) CHECK(labels[v].texel == before[v].texel);
}
