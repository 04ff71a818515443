#include "sim/solids/open_faces.h"

#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("open faces: of one face exact for straight edges, and complementary", "[sim]") {
  CHECK(openAreaFraction(1, 1, 1, 1) == 1.0);
  CHECK(openAreaFraction(-1, -1, -1, -1) == 0.0);
  CHECK(openAreaFraction(0, 0, 0, 0) == 0.0);
  CHECK(openAreaFraction(0, 0, 1, 1) == 1.0);  // the wall runs along an edge
  CHECK(openAreaFraction(0, 0, -1, -1) == 0.0);
  CHECK_THAT(openAreaFraction(1, 1, -1, -1), WithinAbs(0.5, 1e-15));
  CHECK_THAT(openAreaFraction(0.25, 0.25, -0.75, -0.75), WithinAbs(0.25, 1e-15));
  CHECK_THAT(openAreaFraction(1, -1, -1, -1), WithinAbs(0.125, 1e-15));
  CHECK_THAT(openAreaFraction(-1, 1, 1, 1), WithinAbs(0.875, 1e-15));
  CHECK_THAT(openAreaFraction(1, -2, 1, -2), WithinAbs(2.0 / 18.0, 1e-15));  // a saddle, corners apart
  CHECK_THAT(openAreaFraction(2, -1, 2, -1), WithinAbs(1.0 - 2.0 / 18.0, 1e-15));
  for (const auto& d :
       {std::array<double, 4>{0.3, -0.2, 0.5, 0.7}, {0.3, -0.4, 0.1, -0.7}, {-0.3, -0.4, 0.9, -0.7}}) {
    CHECK_THAT(openAreaFraction(d[0], d[1], d[2], d[3]) + openAreaFraction(-d[0], -d[1], -d[2], -d[3]),
               WithinAbs(1.0, 1e-12));
    CHECK_THAT(openAreaFraction(d[1], d[2], d[3], d[0]),
               WithinAbs(openAreaFraction(d[0], d[1], d[2], d[3]), 1e-12));
  }
}

TEST_CASE("open faces: open areas of a tilted half-space are exact", "[sim]") {
  const double slope = std::tan(20.0 * std::numbers::pi / 180.0);
  const Vec3d normal(-slope, 0.0, 1.0);
  const int n = 24;
  const double h = 1.0 / n;
  Solids solids(tankWith(n, {solidOf(Shape{HalfSpace{Vec3d(0.0, 0.0, 0.2), normal}})}));
  const auto field = solids.at(0.0);
  const auto heightAt = [&](double x) { return 0.2 + slope * x; };
  int cut = 0;
  for (int i = 1; i < n; ++i) {
    for (int k = 1; k < n; ++k) {
      const Coord c(i, 7, k);
      // A face normal to x is open above one height.
      const double expected = std::clamp(((k + 1) * h - heightAt(i * h)) / h, 0.0, 1.0);
      if (expected > 2e-3 || expected == 0.0)
        REQUIRE_THAT(field->open[0].tree().getValue(c), WithinAbs(expected, 1e-6));
      // A face normal to z is open left of where the plane reaches it.
      const double reach = std::clamp((k * h - 0.2) / slope / h - i, 0.0, 1.0);
      if (reach > 2e-3 || reach == 0.0)
        REQUIRE_THAT(field->open[2].tree().getValue(c), WithinAbs(reach, 1e-6));
      cut += reach > 0.0 && reach < 1.0;
    }
  }
  CHECK(cut >= 8);
}

TEST_CASE("open faces: closed areas of a sphere sum to its shadow, at second order", "[sim]") {
  const auto shadow = [](int n) {
    Solids solids(tankWith(n, {solidOf(Shape{Sphere{Vec3d(0.51, 0.49, 0.47), 0.31}})}));
    const auto field = solids.at(0.0);
    // The divergence theorem on the open part of each cell: the sum over cells of the positive part of the
    // solid's area vector is the area of the shadow along that axis.
    double area = 0.0;
    for (int i = 1; i + 1 < n; ++i) {
      for (int j = 1; j + 1 < n; ++j) {
        for (int k = 1; k + 1 < n; ++k) {
          const Coord c(i, j, k);
          area += std::max(
              0.0f, field->open[2].tree().getValue(c.offsetBy(0, 0, 1)) - field->open[2].tree().getValue(c));
        }
      }
    }
    return area / (n * n);
  };
  const double exact = std::numbers::pi * 0.31 * 0.31;
  const double coarse = std::abs(shadow(20) - exact), fine = std::abs(shadow(80) - exact);
  CAPTURE(coarse, fine);
  CHECK(fine < 3e-4);
  CHECK(fine < coarse / 8.0);
}

TEST_CASE("open faces: a wall in the plane of faces closes them", "[sim]") {
  // 0.3 is no multiple of 1/10 in binary.
  Solids solids(tankWith(10, {solidOf(Shape{Box{Vec3d(0.3, -1.0, -1.0), Vec3d(0.7, 2.0, 0.6)}})}));
  const auto field = solids.at(0.0);
  CHECK(field->open[0].tree().getValue(Coord(3, 5, 2)) == 0.0f);
  CHECK(field->open[0].tree().getValue(Coord(2, 5, 2)) == 1.0f);
  CHECK(field->open[0].tree().getValue(Coord(7, 5, 2)) == 0.0f);
  CHECK(field->open[0].tree().getValue(Coord(3, 5, 6)) == 1.0f);
  CHECK(field->open[2].tree().getValue(Coord(3, 5, 6)) == 0.0f);
  CHECK(field->open[2].tree().getValue(Coord(2, 5, 6)) == 1.0f);
}

TEST_CASE("open faces: no face leads into what a wall leaves of a cell beyond it") {
  for (const double more : {-0.009, 1e-5, 0.009}) {
    const auto field =
        Solids(tankWith(16, {solidOf(Shape{Box{Vec3d(-1.0, -1.0, (8.0 + more) / 16), Vec3d(2.0)}})})).at(0.0);
    CAPTURE(more);
    CHECK(field->open[2].tree().getValue(Coord(8, 8, 8)) == 0.0f);
    CHECK(field->open[0].tree().getValue(Coord(8, 8, 8)) == 0.0f);
    CHECK(field->open[0].tree().getValue(Coord(8, 8, 7)) == 1.0f);
  }
}

TEST_CASE("open faces: a gap in which no corner of the grid lies is closed") {
  for (const double gap : {0.3, 0.6, 0.9, 1.0, 1.1}) {  // cells between the floor and a block
    Options options;
    options.resolution = 16;
    const double h = options.voxelSize();
    options.solids.resize(1);
    options.solids[0].shape = {Box{Vec3d(0.25, 0.25, gap * h), Vec3d(0.75, 0.75, 0.6)}};
    Solids solids(options);
    const auto field = solids.at(0.0);
    const float inGap = field->phi->tree().getValue(Coord(8, 8, 0));
    CAPTURE(gap);
    const float face = field->open[0].tree().getValue(Coord(8, 8, 0));
    CHECK((inGap > 0.0f) == (gap >= 1.0));
    CHECK(face == Catch::Detail::Approx(gap >= 1.0 ? 1.0 : 0.0));
    CHECK(field->phi->tree().getValue(Coord(1, 1, 0)) > 0.0f);
  }
}

TEST_CASE("open faces: a solid whose edge just reaches between two cells leaves their face open beside it") {
  // A plate in the plane of the faces, as a wedge's edge: it ends 0.02 cells beyond the cells' centres.
  constexpr double kCells = 16.0;
  const Box plate{Vec3d(-1.0, -1.0, 7.7 / kCells), Vec3d(8.52 / kCells, 2.0, 8.3 / kCells)};
  const auto field = Solids(tankWith(16, {solidOf(Shape{plate})})).at(0.0);
  const float beside = field->open[2].tree().getValue(Coord(8, 8, 8));
  CHECK(beside > 0.3f);
  CHECK(beside < 0.7f);
  CHECK(field->open[2].tree().getValue(Coord(7, 8, 8)) == 0.0f);
  CHECK(field->open[2].tree().getValue(Coord(9, 8, 8)) == 1.0f);
}

TEST_CASE(
    "open faces: the open area of a gap narrower than a cell is its width, wherever a corner lies in it") {
  constexpr double h = 1.0 / 16;
  constexpr double kGap = 0.6;
  for (const double corner : {0.05, 0.15, 0.3, 0.45, 0.55}) {  // of a grid plane above the lower block's top
    const double low = (8.0 - corner) * h;
    const Box below{Vec3d(-1.0), Vec3d(2.0, 2.0, low)}, above{Vec3d(-1.0, -1.0, low + kGap * h), Vec3d(2.0)};
    const auto field = Solids(tankWith(16, {solidOf(Shape{below}), solidOf(Shape{above})})).at(0.0);
    const auto open = [&](int axis, int k) { return field->open[axis].tree().getValue(Coord(8, 8, k)); };
    CAPTURE(corner);
    for (const int axis : {0, 1}) {
      CHECK_THAT(open(axis, 7), WithinAbs(corner, 0.011));
      CHECK_THAT(open(axis, 8), WithinAbs(kGap - corner, 0.011));
    }
    CHECK(open(2, 8) == 1.0f);
  }
}
