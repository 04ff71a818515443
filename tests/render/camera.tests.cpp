#include "render/camera.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

namespace {

Camera slantedCamera() {
  Camera camera;
  camera.from = Vec3d(3.0, -2.0, 1.5);
  camera.at = Vec3d(0.5, 0.25, 0.125);
  camera.fov = 40.0;
  return camera;
}

bool near(const Vec3f& a, const Vec3f& b) {
  return (a - b).length() < 1e-5f;
}

}  // namespace

TEST_CASE("camera: the middle of the picture is what it looks at", "[render]") {
  const Camera camera = slantedCamera();
  const CameraRays rays = makeCamera(camera, 321, 123, 0.0);
  const Vec3d towards = camera.at - camera.from;
  REQUIRE(near(rays.direction(160.5f, 61.5f), Vec3f(towards / towards.length())));
}

TEST_CASE("camera: fov is the angle between the top and the bottom edge", "[render]") {
  const CameraRays rays = makeCamera(slantedCamera(), 300, 200, 0.0);
  const float cosine = rays.direction(150.0f, 0.0f).dot(rays.direction(150.0f, 200.0f));
  REQUIRE(std::acos(cosine) * 180.0f / kPi == Approx(40.0f).epsilon(1e-4));
}

TEST_CASE("camera: right is right and up is up", "[render]") {
  Camera camera;
  camera.from = Vec3d(0.0, -5.0, 0.0);
  camera.at = Vec3d(0.0);
  const CameraRays rays = makeCamera(camera, 100, 100, 0.0);
  REQUIRE(rays.direction(100.0f, 50.0f)[0] > 0.1f);
  REQUIRE(rays.direction(50.0f, 0.0f)[2] > 0.1f);
  REQUIRE(rays.direction(0.0f, 50.0f)[0] < -0.1f);
}

TEST_CASE("camera: it turns around the vertical axis through the point it looks at", "[render]") {
  Camera camera = slantedCamera();
  camera.turn = 90.0;
  const Vec3f at(camera.at);
  const Vec3f arm = Vec3f(camera.from) - at;
  REQUIRE(near(makeCamera(camera, 10, 10, 0.0).origin, at + arm));
  REQUIRE(near(makeCamera(camera, 10, 10, 1.0).origin, at + Vec3f(-arm[1], arm[0], arm[2])));
  for (const double progress : {0.1, 0.5, 0.9}) {
    const CameraRays rays = makeCamera(camera, 10, 10, progress);
    REQUIRE((rays.origin - at).length() == Approx(arm.length()));
    REQUIRE(rays.origin[2] == Approx(1.5f));
    REQUIRE(near(rays.direction(5.0f, 5.0f), (at - rays.origin) / (at - rays.origin).length()));
  }
  camera.turn = 360.0;
  REQUIRE(near(makeCamera(camera, 10, 10, 1.0).origin, at + arm));
}

TEST_CASE("camera: it can look straight down", "[render]") {
  Camera camera;
  camera.from = Vec3d(0.0, 0.0, 5.0);
  camera.at = Vec3d(0.0);
  const CameraRays rays = makeCamera(camera, 100, 100, 0.0);
  REQUIRE(near(rays.direction(50.0f, 50.0f), Vec3f(0.0f, 0.0f, -1.0f)));
  REQUIRE(rays.direction(100.0f, 50.0f)[0] > 0.1f);
  REQUIRE(rays.direction(50.0f, 0.0f)[1] > 0.1f);
}

TEST_CASE("camera: impossible ones are refused", "[render]") {
  Camera camera = slantedCamera();
  camera.at = camera.from;
  REQUIRE_THROWS_AS(makeCamera(camera, 10, 10, 0.0), std::invalid_argument);
  camera = slantedCamera();
  for (const double fov : {0.0, -5.0, 180.0, std::nan("")}) {
    camera.fov = fov;
    REQUIRE_THROWS_AS(makeCamera(camera, 10, 10, 0.0), std::invalid_argument);
  }
}

TEST_CASE("camera: what lies in the plane of focus is sharp, whatever place of the lens sees it",
          "[render]") {
  Camera camera;
  camera.from = Vec3d(0.0, -3.0, 1.0);
  camera.at = Vec3d(0.0, 0.0, 1.0);
  camera.aperture = 0.2;
  for (const double focus : {0.0, 1.5}) {
    camera.focus = focus;
    const CameraRays rays = makeCamera(camera, 64, 36, 0.0);
    const float sharp = focus > 0.0 ? 1.5f : 3.0f;
    for (const Vec2f& place : {Vec2f(0.0f, 0.0f), Vec2f(1.0f, 0.0f), Vec2f(-0.5f, 0.7f)}) {
      const auto [origin, direction] = rays.fromLens(50.0f, 9.0f, place);
      CHECK((origin - rays.origin).length() == Approx(0.1f * place.length()).margin(1e-6));
      CHECK((origin - rays.origin).dot(rays.forward) == Approx(0.0f).margin(1e-6));
      const Vec3f straight = rays.direction(50.0f, 9.0f);
      const Vec3f meets = rays.origin + straight * (sharp / straight.dot(rays.forward));
      CHECK(((meets - origin) - direction * (meets - origin).dot(direction)).length() < 1e-5f);
    }
  }
}

TEST_CASE("camera: a pinhole sees the same from all of its lens", "[render]") {
  const CameraRays rays = makeCamera(Camera(), 64, 36, 0.0);
  const auto [origin, direction] = rays.fromLens(10.0f, 20.0f, Vec2f(0.3f, 0.9f));
  CHECK(origin == rays.origin);
  CHECK(direction == rays.direction(10.0f, 20.0f));
}
