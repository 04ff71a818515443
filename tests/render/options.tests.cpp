#include "render/options.h"

#include "render/camera.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::render;

TEST_CASE("options: there is relief where a map is named and it has a height", "[render]") {
  CHECK_FALSE(Bump().any());
  CHECK(Bump{"height"}.any());
  CHECK(Bump{"height", -0.5}.any());
  CHECK_FALSE(Bump{"height", 0.0}.any());
  CHECK_FALSE(Bump{"", 2.0}.any());
}

TEST_CASE("options: the default view shows all of a tank of 1 m, and not much more", "[render]") {
  const Options options;
  const CameraRays rays = makeCamera(options.camera, options.width, options.height, 0.0);
  float least = 1.0f, most = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3f towards = Vec3f(float(corner & 1), float(corner >> 1 & 1), float(corner >> 2)) - rays.origin;
    const float depth = towards.dot(rays.forward);
    REQUIRE(depth > 0.0f);
    const float x = rays.center[0] + towards.dot(rays.right) / depth / lengthSquared(rays.right);
    const float y = rays.center[1] + towards.dot(rays.down) / depth / lengthSquared(rays.down);
    CHECK((x > 0.0f && x < float(options.width)));
    least = std::min(least, y / float(options.height));
    most = std::max(most, y / float(options.height));
  }
  CHECK((least > 0.0f && least < 0.2f));
  CHECK((most < 1.0f && most > 0.8f));
}
