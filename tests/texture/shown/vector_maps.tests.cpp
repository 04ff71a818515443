#include "texture/shown/vector_maps.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/mesh/closed_meshes.h"
#include "texture/orientation/tangent.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

constexpr double kSpacing = 0.1;

// One vertex that looks along z, whose exemplar lies turned by `angle`, counter-clockwise seen from above,
// and drawn out along its rows by `stretch`.
TexturedSurface oneVertex(float angle, float stretch) {
  TexturedSurface surface;
  surface.spacing = kSpacing;
  surface.exemplarWidth = surface.exemplarHeight = 8;
  surface.positions = {Vec3f(0.0f)};
  surface.normals = {Vec3f(0, 0, 1)};
  surface.coordinate = {Vec2f(3.0f, 3.0f)};
  surface.fading = noFading(1);
  const Vec3f right(std::cos(angle), std::sin(angle), 0.0f);
  const Vec3f down = rowAxis(right, surface.normals[0]);
  surface.gradient = {{right / float(kSpacing * stretch), down / float(kSpacing)}};
  return surface;
}

ExemplarMap everywhere(const Vec3f& vector, MapHolds holds) {
  return {imageOf(8, 8, 3, [&](int, int, int c) { return 0.5f + 0.5f * vector[c]; }), holds};
}

Vec3f lookedUp(const ExemplarMap& map, TexturedSurface surface) {
  lookUpVectors("bump", map, true, surface);
  return surface.vectors.at("bump").at(0);
}

void near(const Vec3f& a, const Vec3f& b) {
  INFO(a << " should be " << b);
  CHECK((a - b).length() < 1e-5f);
}

}  // namespace

TEST_CASE("vector maps: a vector lies on the surface as the picture does") {
  const Vec3f stored = Vec3f(0.3f, 0.6f, 0.7f).unit();
  const MapHolds holds = GENERATE(MapHolds::normals, MapHolds::directions);
  near(lookedUp(everywhere(stored, holds), oneVertex(0.0f, 1.0f)), stored);
  const float angle = GENERATE(0.5f, 2.0f, -3.0f);
  const Vec3f turned(std::cos(angle) * stored.x() - std::sin(angle) * stored.y(),
                     std::sin(angle) * stored.x() + std::cos(angle) * stored.y(), stored.z());
  near(lookedUp(everywhere(stored, holds), oneVertex(angle, 1.0f)), turned);
}

TEST_CASE("vector maps: drawn-out bumps are flatter, drawn-out directions lie along") {
  const float stretch = 2.0f;
  // Of a height z = -a x / spacing the normal is (a, 0, 1); twice as long it is half as steep.
  near(lookedUp(everywhere(Vec3f(0.6f, 0.0f, 0.8f), MapHolds::normals), oneVertex(0.0f, stretch)),
       Vec3f(0.6f / 0.8f / stretch, 0.0f, 1.0f).unit());
  near(lookedUp(everywhere(Vec3f(1.0f, 1.0f, 0.0f) * float(M_SQRT1_2), MapHolds::directions),
                oneVertex(0.0f, stretch)),
       Vec3f(stretch, 1.0f, 0.0f).unit());
  // The middle of eight bits stands for none.
  const float middle = 2.0f * 128.0f / 255.0f - 1.0f;
  near(lookedUp(everywhere(Vec3f(middle), MapHolds::directions), oneVertex(0.0f, stretch)), Vec3f(0.0f));
}

TEST_CASE("vector maps: bumps of a larger texture are as steep") {
  TexturedSurface surface = oneVertex(0.0f, 3.0f);
  surface.gradient[0].t = surface.gradient[0].t / 3.0f;
  surface.scale = {3.0f};
  const Vec3f stored = Vec3f(0.3f, 0.6f, 0.7f).unit();
  near(lookedUp(everywhere(stored, MapHolds::normals), surface), stored);
}

TEST_CASE("vector maps: what fades is mixed in as it lies itself") {
  TexturedSurface surface = oneVertex(0.0f, 1.0f);
  const TexturedSurface former = oneVertex(float(M_PI_2), 1.0f);
  surface.fading.coordinate = former.coordinate;
  surface.fading.gradient = former.gradient;
  surface.fading.weight = {0.5f};
  near(lookedUp(everywhere(Vec3f(1.0f, 0.0f, 0.0f), MapHolds::directions), surface),
       Vec3f(1.0f, 1.0f, 0.0f).unit());
}

TEST_CASE("vector maps: parts read from a file before give way") {
  TexturedSurface surface = oneVertex(0.0f, 1.0f);
  for (const std::string& part : vectorNames("bump")) surface.maps[part] = {0.0f};
  surface.maps["bumpy"] = {0.0f};
  lookUpVectors("bump", everywhere(Vec3f(0, 0, 1), MapHolds::normals), true, surface);
  CHECK(surface.maps.size() == 1);
  CHECK(surface.maps.contains("bumpy"));
}

TEST_CASE("vector maps: gradients are recovered from coordinates alone, also those of what fades") {
  const SurfaceMesh mesh = sphereMesh(20);
  TexturedSurface surface;
  surface.spacing = mesh.spacing;
  surface.positions = mesh.positions;
  surface.normals = mesh.normals;
  surface.triangles = mesh.triangles;
  surface.orientation = referenceVectors(mesh.normals);
  surface.exemplarWidth = surface.exemplarHeight = 1000;
  surface.gradient.resize(mesh.positions.size());
  surface.fading = noFading(mesh.positions.size());
  const float scale = 1.0f / float(mesh.spacing);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& x = mesh.positions[v];
    surface.coordinate.emplace_back(500.0f + scale * x.x(), 500.0f - scale * x.y());
    surface.fading.coordinate[v] = Vec2f(500.0f + scale * x.y(), 500.0f + scale * x.x());
  }
  recoverGradients(false, surface);
  // Where the surface looks along z, whose gradients lie in it; elsewhere they are foreshortened.
  int seen = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.normals[v].z() < 0.95f) continue;
    ++seen;
    const auto along = [&](const Vec3f& axis) {
      return (axis - mesh.normals[v] * mesh.normals[v].dot(axis)) * scale;
    };
    CHECK((surface.gradient[v].s - along({1, 0, 0})).length() < 0.05f * scale);
    CHECK((surface.gradient[v].t - along({0, -1, 0})).length() < 0.05f * scale);
    CHECK((surface.fading.gradient[v].s - along({0, 1, 0})).length() < 0.05f * scale);
    CHECK((surface.fading.gradient[v].t - along({1, 0, 0})).length() < 0.05f * scale);
  }
  CHECK(seen > 50);
}

TEST_CASE("vector maps: a map of values, or without three channels, is refused") {
  TexturedSurface surface = oneVertex(0.0f, 1.0f);
  CHECK_THROWS_AS(lookUpVectors("a", {noiseImage(4, 4, 1, 1), MapHolds::normals}, false, surface),
                  std::invalid_argument);
  CHECK_THROWS_AS(lookUpVectors("a", {noiseImage(4, 4, 3, 1), MapHolds::values}, false, surface),
                  std::invalid_argument);
}
