#include "transport/foam.h"

#include "tests/transport/textured_meshes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

namespace {

// Sheared: the velocity along x grows by `rate` (1/s) with z.
sim::Frame shearedFrame(double rate) {
  return steadyFrame({0.1, -20, 20}, 0.1, 1, [=](const Vec3d& x) { return Vec3d(rate * x.z(), 0.0, 0.0); });
}

Carried foamy(std::size_t count, float amount, float trust) {
  Carried carried;
  carried.foam.assign(count, amount);
  carried.trust.assign(count, trust);
  return carried;
}

}  // namespace

TEST_CASE("foam: there is as much as the velocity's gradient asks for", "[transport]") {
  const std::vector<Vec3f> x = sphereMesh(8).positions;
  const texture::Foam options{.from = 2.0, .full = 6.0, .lifetime = 1.0};
  const auto most = [&](double rate) {
    const std::vector<float> foam = foamAfter(x, shearedFrame(rate), {}, 0.1, options);
    CHECK(*std::min_element(foam.begin(), foam.end()) ==
          Approx(*std::max_element(foam.begin(), foam.end())).margin(1e-3));
    return foam.front();
  };
  CHECK(most(1.9) == 0.0f);
  CHECK(most(4.0) == Approx(0.5).margin(1e-3));
  CHECK(most(-4.0) == Approx(0.5).margin(1e-3));
  CHECK(most(6.1) == 1.0f);
}

TEST_CASE("foam: what was carried fades, and goes where the surface is not the same", "[transport]") {
  const std::vector<Vec3f> x = sphereMesh(8).positions;
  const texture::Foam options{.from = 2.0, .full = 6.0, .lifetime = 2.0};
  for (const float foam : foamAfter(x, shearedFrame(0.5), foamy(x.size(), 0.8f, 1.0f), 0.5, options))
    CHECK(foam == Approx(0.8 * std::exp(-0.25)));
  for (const float foam : foamAfter(x, shearedFrame(0.5), foamy(x.size(), 0.8f, 0.0f), 0.5, options))
    CHECK(foam == 0.0f);
  for (const float foam : foamAfter(x, shearedFrame(4.0), foamy(x.size(), 0.1f, 1.0f), 0.5, options))
    CHECK(foam == Approx(0.5).margin(1e-3));
  for (const float foam : foamAfter(x, sim::Frame{}, {}, 0.5, options)) CHECK(foam == 0.0f);
}

TEST_CASE("foam: none comes up where the velocity ends", "[transport]") {
  // Known below 0.5 only, and the same everywhere.
  const sim::Frame frame =
      steadyFrame({0.1, -20, 5}, 0.1, 1, [](const Vec3d&) { return Vec3d(30.0, 20.0, 10.0); });
  std::vector<Vec3f> x;
  for (float at = -0.6f; at < 0.9f; at += 0.01f) x.push_back(Vec3f(at));
  for (const float foam : foamAfter(x, frame, {}, 0.1, {.from = 0.1, .full = 1.0, .lifetime = 1.0}))
    CHECK(foam == 0.0f);
}

TEST_CASE("foam: carried along with the surface, where there is any", "[transport]") {
  const Vec3d shift(0.13, -0.07, 0.21);
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.1, 2, [&](const Vec3d&) { return shift / 0.1; });
  const SurfaceMesh before = sphereMesh(24), after = sphereMesh(19, 1.0, shift);
  TexturedSurface previous = texturedMesh(before, constantDirection({0.3, 0.5, 0.8}));
  CHECK(carry(previous, frame, after).foam.empty());
  std::vector<float>& foam = previous.foam;
  for (const Vec3f& x : before.positions) foam.push_back(0.5f + 0.4f * x.z());
  const Carried carried = carry(previous, frame, after);
  REQUIRE(carried.foam.size() == after.positions.size());
  for (std::size_t v = 0; v < after.positions.size(); ++v)
    CHECK(carried.foam[v] == Approx(0.5 + 0.4 * (after.positions[v].z() - shift.z())).margin(0.01));
}

TEST_CASE("foam: what is carried must fit, and the options make sense", "[transport]") {
  const std::vector<Vec3f> x = sphereMesh(4).positions;
  const texture::Foam options{.from = 2.0, .full = 6.0, .lifetime = 2.0};
  CHECK_THROWS_AS(foamAfter(x, {}, foamy(x.size() - 1, 0.5f, 1.0f), 0.1, options), std::invalid_argument);
  CHECK_THROWS_AS(foamAfter(x, {}, {}, 0.1, {.from = 2.0, .full = 6.0, .lifetime = 0.0}),
                  std::invalid_argument);
  CHECK_THROWS_AS(foamAfter(x, {}, {}, 0.1, {.from = 6.0, .full = 6.0, .lifetime = 2.0}),
                  std::invalid_argument);
}
