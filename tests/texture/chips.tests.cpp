#include "texture/chips.h"

#include "tests/texture/oriented_mesh.h"
#include "tests/texture/test_images.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

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
  for (const float radius : {0.5f, 1.5f, 2.5f}) {
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
