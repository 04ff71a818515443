#include "caches/liquid/cells_crossed.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::caches;
using openvdb::Vec3f;
using openvdb::Vec3I;

TEST_CASE("cells crossed: as many as a triangle's area, or its length where it is thin", "[caches]") {
  const SurfaceTriangles right{{Vec3f(0, 0, 0), Vec3f(3, 0, 0), Vec3f(0, 4, 0)}, {Vec3I(0, 1, 2)}};
  CHECK(cellsCrossed(right, 0.5).cells == Approx(6.0 / 0.25));
  CHECK(cellsCrossed(right, 4.0).cells == Approx(5.0 / 4.0));
  SurfaceTriangles both = right;
  both.points.emplace_back(1.5f, 2.0f, 0.0f);
  both.triangles.emplace_back(1, 2, 3);  // of no area
  CHECK(cellsCrossed(both, 0.5).cells == Approx(6.0 / 0.25 + 5.0 / 0.5));
  CHECK(cellsCrossed({}, 0.5).cells == 0.0);
}

TEST_CASE("cells crossed: as far as a corner's largest coordinate, of those in triangles", "[caches]") {
  const SurfaceTriangles surface{{Vec3f(1, 2, 3), Vec3f(1, -7, 3), Vec3f(0, 4, 5), Vec3f(100, 0, 0)},
                                 {Vec3I(0, 1, 2)}};
  CHECK(cellsCrossed(surface, 0.5).farthest == 7.0);
  CHECK(cellsCrossed({}, 0.5).farthest == 0.0);
}

TEST_CASE("cells crossed: what takes too much memory or is too far to tell places apart does not fit",
          "[caches]") {
  CHECK(CellsCrossed{3e7, 4e5}.fits(0.1));
  CHECK_FALSE(CellsCrossed{3.1e7, 0.0}.fits(0.1));
  CHECK_FALSE(CellsCrossed{0.0, 4.1e5}.fits(0.1));
  // One stray vertex, near or far.
  SurfaceTriangles surface{{Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0)}, {Vec3I(0, 1, 2)}};
  CHECK(cellsCrossed(surface, 0.01).fits(0.01));
  for (const float far : {1e5f, 1e30f, std::numeric_limits<float>::infinity()}) {
    surface.points[2][1] = far;
    CHECK_FALSE(cellsCrossed(surface, 0.01).fits(0.01));
  }
}
