#include "transport/cubic_directions.h"

#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

namespace {

// The upper side of a flat box, whose direction turns by `rate` radians a metre along x.
TexturedSurface turning(double rate) {
  OrientedMesh box = flatBox(16);
  TexturedSurface surface;
  static_cast<texture::SurfaceMesh&>(surface) = box.mesh;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    if (surface.normals[v].z() < 0.99f) continue;
    const double angle = rate * surface.positions[v].x();
    surface.orientation[v] = {float(std::cos(angle)), float(std::sin(angle)), 0.0f};
  }
  return surface;
}

Landing landingOn(const TexturedSurface& surface, const Vec3f& x) {
  return landingAt(surface,
                   ClosestPoint(surface.positions, surface.triangles).nearest(Vec3d(x), Vec3f(0, 0, 1), 0.0));
}

}  // namespace

TEST_CASE("cubic directions: the angle's slope is that of a field that turns evenly", "[transport]") {
  const TexturedSurface surface = turning(0.1);
  const std::vector<Vec3f> slopes = angleSlopes(surface, 1);
  const std::uint32_t v = nearestVertex(surface, Vec3f(8, 8, 2));
  CHECK((slopes[v] - Vec3f(0.1f, 0.0f, 0.0f)).length() < 0.002f);
}

TEST_CASE("cubic directions: between vertices an even turn is followed, unit and tangent", "[transport]") {
  const TexturedSurface surface = turning(0.1);
  const std::vector<Vec3f> slopes = angleSlopes(surface, 1);
  for (const Vec3f& x : {Vec3f(7.3f, 8.2f, 2.0f), Vec3f(8.5f, 7.5f, 2.0f), Vec3f(9.0f, 8.0f, 2.0f)}) {
    const Vec3f d = directionAt(surface, slopes, landingOn(surface, x), 1);
    CHECK(d.length() == Approx(1.0f));
    CHECK(std::abs(d.z()) < 1e-5f);
    CHECK((d - Vec3f(std::cos(0.1f * x.x()), std::sin(0.1f * x.x()), 0.0f)).length() < 1e-3f);
  }
}

TEST_CASE("cubic directions: directions that symmetry makes equal are one", "[transport]") {
  TexturedSurface surface = turning(0.0);
  for (std::size_t v = 0; v < surface.positions.size(); v += 2)
    if (surface.normals[v].z() > 0.99f) surface.orientation[v] = -surface.orientation[v];
  const std::vector<Vec3f> slopes = angleSlopes(surface, 2);
  CHECK(slopes[nearestVertex(surface, Vec3f(8, 8, 2))].length() < 1e-4f);
  const Vec3f d = directionAt(surface, slopes, landingOn(surface, Vec3f(8.4f, 8.3f, 2.0f)), 2);
  CHECK(std::abs(d.x()) == Approx(1.0f).margin(1e-4));
}
