#include "texture/surface.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

TEST_CASE("surface: rows run rightwards and columns downwards, seen from outside", "[texture]") {
  // Seen from above, x to the right and y upwards.
  CHECK(rowAxis(Vec3f(1, 0, 0), Vec3f(0, 0, 1)) == Vec3f(0, -1, 0));
  CHECK(rowAxis(Vec3f(0, 1, 0), Vec3f(0, 0, 1)) == Vec3f(1, 0, 0));
  CHECK(rowAxis(Vec3f(1, 0, 0), Vec3f(0, 0, -1)) == Vec3f(0, 1, 0));
}

TEST_CASE("surface: a pixel is as large as the spacing, times the scale where there is one", "[texture]") {
  SurfaceMesh mesh;
  mesh.spacing = 0.5;
  CHECK(mesh.spacingAt(7) == 0.5);
  mesh.scale = {1.0f, 3.0f};
  CHECK(mesh.spacingAt(0) == 0.5);
  CHECK(mesh.spacingAt(1) == 1.5);
}

TEST_CASE("surface: empty is what has no level, or no vertex at the finest", "[texture]") {
  Surface surface;
  CHECK(surface.empty());
  surface.levels.resize(2);
  surface.levels[1].positions.resize(3);
  CHECK(surface.empty());
  surface.levels[0].positions.resize(1);
  CHECK_FALSE(surface.empty());
  Carried carried;
  CHECK(carried.empty());
  carried.previousPosition.resize(1);
  CHECK_FALSE(carried.empty());
  TexturedSurface textured;
  CHECK(textured.empty());
  textured.positions.resize(1);
  CHECK_FALSE(textured.empty());
}

TEST_CASE("surface: without a cross-fade all weights are zero", "[texture]") {
  const Fading fading = noFading(3);
  CHECK(fading.coordinate == std::vector<Vec2f>(3, Vec2f(0.0f)));
  CHECK(fading.gradient.size() == 3);
  CHECK(fading.weight == std::vector<float>(3, 0.0f));
  CHECK(fading.speed == std::vector<float>(3, 0.0f));
}
