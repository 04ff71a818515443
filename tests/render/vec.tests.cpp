#include "render/vec.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

namespace {

bool isAbout(const Vec3f& a, const Vec3f& b) {
  return (a - b).length() < 1e-6f;
}

}  // namespace

TEST_CASE("vectors: of length 1 in their own direction, but for the null vector", "[render]") {
  CHECK(lengthSquared(Vec3f(1.0f, -2.0f, 3.0f)) == 14.0f);
  CHECK(isAbout(normalized(Vec3f(0.0f, -3.0f, 4.0f)), Vec3f(0.0f, -0.6f, 0.8f)));
  CHECK(isAbout(normalized(Vec3f(1e-15f, 0.0f, 0.0f)), Vec3f(1.0f, 0.0f, 0.0f)));
  CHECK(normalized(Vec3f(0.0f)) == Vec3f(0.0f));
}

TEST_CASE("vectors: brightness is that of Rec. 709, of white 1", "[render]") {
  CHECK(luminance(Vec3f(1.0f)) == Approx(1.0));
  CHECK(luminance(Vec3f(1.0f, 0.0f, 0.0f)) == Approx(0.2126));
  CHECK(luminance(Vec3f(0.0f, 2.0f, 0.0f)) == Approx(2.0 * 0.7152));
  CHECK(luminance(Vec3f(0.0f, 0.0f, 1.0f)) == Approx(0.0722));
}

TEST_CASE("vectors: the largest part, wherever it is", "[render]") {
  CHECK(largest(Vec3f(3.0f, 1.0f, 2.0f)) == 3.0f);
  CHECK(largest(Vec3f(1.0f, 3.0f, 2.0f)) == 3.0f);
  CHECK(largest(Vec3f(-3.0f, -2.0f, -1.0f)) == -1.0f);
}

TEST_CASE("vectors: mixed and smooth steps have their closed forms", "[render]") {
  const Vec3f a(1.0f, 2.0f, 3.0f), b(3.0f, 2.0f, -1.0f);
  CHECK(mix(a, b, 0.0f) == a);
  CHECK(mix(a, b, 1.0f) == b);
  CHECK(isAbout(mix(a, b, 0.25f), Vec3f(1.5f, 2.0f, 2.0f)));
  CHECK(smoothStep(2.0f, 4.0f, 1.0f) == 0.0f);
  CHECK(smoothStep(2.0f, 4.0f, 2.5f) == 0.15625f);  // 3 t^2 - 2 t^3
  CHECK(smoothStep(2.0f, 4.0f, 3.0f) == 0.5f);
  CHECK(smoothStep(2.0f, 4.0f, 5.0f) == 1.0f);
}

TEST_CASE("axes: orthonormal and right-handed around any direction, straight down too", "[render]") {
  for (const Vec3f& direction :
       {Vec3f(0.0f, 0.0f, 1.0f), Vec3f(0.0f, 0.0f, -1.0f), Vec3f(1.0f, 0.0f, 0.0f), Vec3f(0.0f, -1.0f, 0.0f),
        Vec3f(1.0f, 2.0f, 3.0f), Vec3f(-2.0f, 1.0f, -0.001f), Vec3f(1e-4f, -1e-4f, -1.0f),
        Vec3f(0.3f, 0.2f, -0.0f)}) {
    const Vec3f z = normalized(direction);
    const Axes axes(z);
    CAPTURE(z);
    CHECK(axes.z == z);
    CHECK(axes.x.length() == Approx(1.0).margin(1e-6));
    CHECK(axes.y.length() == Approx(1.0).margin(1e-6));
    CHECK(isAbout(axes.x.cross(axes.y), z));
    const Vec3f v(0.5f, -0.25f, 2.0f);
    CHECK(isAbout(axes.local(axes.world(v)), v));
    CHECK(isAbout(axes.world(Vec3f(0.0f, 0.0f, 1.0f)), z));
    CHECK(axes.local(v)[2] == Approx(v.dot(z)));
  }
}
