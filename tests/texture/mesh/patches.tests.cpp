#include "texture/mesh/patches.h"

#include "tests/texture/mesh/icosahedron.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace fluidtex::texture;

TEST_CASE("patches: places of one cube share a patch, each is in one list") {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-3.0f, 3.0f);
  std::vector<Vec3f> places;
  for (int n = 0; n < 300; ++n) places.emplace_back(place(random), place(random), place(random));
  const Vec3f corner(0.25f, 0.5f, -0.25f);
  const Patches patches = patchesOf(places, 1.5f, corner);
  const auto cube = [&](const Vec3f& x) {
    const Vec3f p = (x - corner) / 1.5f;
    return openvdb::Coord::floor(p);
  };
  REQUIRE(patches.of.size() == places.size());
  for (std::uint32_t a = 0; a < places.size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      REQUIRE((patches.of[a] == patches.of[b]) == (cube(places[a]) == cube(places[b])));
  std::vector<int> listed(places.size(), 0);
  for (std::uint32_t n = 0; n < patches.count(); ++n) {
    const auto from = patches.vertex.begin() + patches.first[n],
               to = patches.vertex.begin() + patches.first[n + 1];
    CHECK(from < to);
    CHECK(std::is_sorted(from, to));
    for (auto v = from; v != to; ++v) {
      ++listed[*v];
      CHECK(patches.owns(n, *v));
    }
  }
  CHECK(listed == std::vector<int>(places.size(), 1));
}

TEST_CASE("patches: a ring is owned only as a whole, removed vertices by none") {
  EditableMesh mesh = icosahedron();
  const Patches whole = patchesOf(mesh, 100.0f, Vec3f(-50.0f));
  CHECK(whole.count() == 1);
  CHECK(whole.ownsRing(mesh, 0, 5));
  const Patches halves = patchesOf(mesh, 100.0f, Vec3f(-100.0f, -50.0f, -50.0f));  // parted at x = 0
  CHECK(halves.count() == 2);
  for (std::uint32_t v = 0; v < 12; ++v) {
    bool all = true;
    mesh.around(v, [&](std::uint32_t h) { all = all && halves.of[mesh.target(h)] == halves.of[v]; });
    CHECK(halves.ownsRing(mesh, halves.of[v], v) == all);
    CHECK_FALSE(halves.ownsRing(mesh, 1 - halves.of[v], v));
  }
  const std::uint32_t gone = mesh.origin[0];
  REQUIRE(mesh.canCollapse(0));
  mesh.collapse(0);
  CHECK(patchesOf(mesh, 100.0f, Vec3f(-50.0f)).of[gone] == kNone);
}

TEST_CASE("patches: each is called once") {
  const EditableMesh mesh = icosahedron();
  const Patches patches = patchesOf(mesh, 0.5f);
  std::vector<int> calls(patches.count(), 0);
  forEachPatch(patches, [&](std::uint32_t n) { ++calls[n]; });
  CHECK(calls == std::vector<int>(patches.count(), 1));
}
