#include "texture/neighborhood/flattener.h"

#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// Columns and rows of a vertex of a flat box's upper side from another.
Vec2f between(const OrientedMesh& box, std::uint32_t from, std::uint32_t to) {
  const Vec3f way = box.mesh.positions[to] - box.mesh.positions[from];
  return {way.x(), -way.y()};
}

bool samePlaces(const std::vector<Flattener::Placed>& a, const std::vector<Flattener::Placed>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.vertex == y.vertex && x.l == y.l && x.turn == y.turn;
  });
}

}  // namespace

TEST_CASE("flattener: a plane stays as it is, all of it within the half width and nothing twice") {
  const OrientedMesh box = flatBox(30);
  const std::uint32_t center = nearestVertex(box.mesh, Vec3f(15, 15, 2));
  Flattener flattener(box.view());
  flattener.flatten(center, 4.5);
  CHECK(flattener.reach() == 4.5);
  const std::vector<Flattener::Placed>& placed = flattener.placed();
  CHECK(placed.front().vertex == center);
  CHECK(placed.front().l == Complexd(0.0));
  CHECK(placed.front().turn == Complexd(1.0));
  std::set<std::uint32_t> inside, all;
  for (const Flattener::Placed& each : placed) {
    const Vec2f exact = between(box, center, each.vertex);
    CHECK(std::abs(each.l - Complexd(double(exact[0]), double(exact[1]))) < 1e-5);
    CHECK(std::abs(each.turn - 1.0) < 1e-6);
    all.insert(each.vertex);
    if (std::max(std::abs(exact[0]), std::abs(exact[1])) < 4.5f) inside.insert(each.vertex);
  }
  CHECK(all.size() == placed.size());
  CHECK(inside.size() == 81);
}

TEST_CASE("flattener: a piece does not depend on those that were flattened before") {
  const OrientedMesh torus = orientedMesh(torusMesh(60, 24));
  Flattener used(torus.view());
  for (std::uint32_t v = 0; v < 300; v += 7) used.flatten(v, 6.5);
  for (const std::uint32_t v : {3u, 700u, 1400u}) {
    Flattener fresh(torus.view());
    fresh.flatten(v, 4.5);
    used.flatten(v, 4.5);
    CHECK(samePlaces(fresh.placed(), used.placed()));
    CHECK(fresh.reach() == used.reach());
    used.flatten(v, 4.5);
    CHECK(samePlaces(fresh.placed(), used.placed()));
  }
}

TEST_CASE("flattener: where the surface folds the piece ends, but not within the ring around its centre") {
  const OrientedMesh ring = orientedMesh(torusMesh(200, 8, 1.0, 0.04)), drop = orientedMesh(sphereMesh(1));
  Flattener around(ring.view()), small(drop.view());
  around.flatten(50, 16.5);
  // Half of the tube's girth, eight vertices.
  CHECK(around.reach() >= 1.5);
  CHECK(around.reach() < 8.0);
  small.flatten(0, 4.5);
  CHECK(small.reach() >= 1.5);
  CHECK(small.reach() < 4.5);
  small.flatten(0, 1.0);
  CHECK(small.reach() == 1.0);
}

TEST_CASE("flattener: pixels have weights of sum one up to the reach, and are missing beyond it") {
  const OrientedMesh ring = orientedMesh(torusMesh(200, 8, 1.0, 0.04));
  Flattener flattener(ring.view());
  const int window = 33, radius = 16;
  for (const std::uint32_t center : {0u, 51u, 802u}) {
    flattener.flatten(center, 0.5 * window);
    std::set<std::uint32_t> placed;
    for (const Flattener::Placed& each : flattener.placed()) placed.insert(each.vertex);
    std::vector<PixelSource> pixels(std::size_t(window * window));
    flattener.rasterize(window, pixels.data());
    const PixelSource& middle = pixels[std::size_t(radius * window + radius)];
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(middle.weight[k] == Approx(middle.vertex[k] == center ? 1.0f : 0.0f).margin(1e-6));
    for (int j = -radius; j <= radius; ++j)
      for (int i = -radius; i <= radius; ++i) {
        const PixelSource& pixel = pixels[std::size_t((j + radius) * window + i + radius)];
        const bool beyond = std::max(std::abs(i), std::abs(j)) > flattener.reach() - 0.5 + 1e-5;
        if (beyond) CHECK(pixel.missing());
        if (pixel.missing()) continue;
        CHECK(pixel.weight[0] + pixel.weight[1] + pixel.weight[2] == Approx(1.0f));
        for (std::size_t k = 0; k < 3; ++k) {
          CHECK(pixel.weight[k] >= 0.0f);
          CHECK(placed.count(pixel.vertex[k]) == 1);
        }
      }
  }
}

TEST_CASE("flattener: seen at half detail, a pixel is read from members alone, most from the nearest") {
  const OrientedMesh box = flatBox(30);
  std::vector<std::uint8_t> members;
  for (const Vec3f& x : box.mesh.positions)
    members.push_back(std::lround(x.x()) % 2 == 1 && std::lround(x.y()) % 2 == 1);
  MeshView view = box.view();
  view.pixel = 2.0f;
  view.members = &members;
  const std::uint32_t center = nearestVertex(box.mesh, Vec3f(15, 15, 2));
  Flattener flattener(view);
  flattener.flatten(center, 5.0);
  std::vector<PixelSource> pixels(25);
  flattener.rasterize(5, pixels.data());
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const PixelSource& pixel = pixels[std::size_t((j + 2) * 5 + i + 2)];
      REQUIRE_FALSE(pixel.missing());
      CHECK(pixel.weight[0] + pixel.weight[1] + pixel.weight[2] == Approx(1.0f));
      for (std::size_t k = 0; k < 3; ++k) {
        if (pixel.weight[k] == 0.0f) continue;
        CHECK(members[pixel.vertex[k]] == 1);
        const Vec2f from = between(box, center, pixel.vertex[k]) - 2.0f * Vec2f(float(i), float(j));
        // The pixel's own vertex, and two neighbours, two spacings away.
        CHECK(from.length() == Approx(pixel.weight[k] > 0.5f ? 0.0f : 2.0f).margin(1e-4));
      }
    }
}
