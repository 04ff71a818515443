#include "sim/solids/solids.h"

#include "sim/grid/mac_grid.h"
#include "tests/sim/solids/solid_scenes.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

TEST_CASE("solids: the domain's faces are walls, all else is open", "[sim]") {
  Options options = tankWith(20);
  options.size = Vec3d(1.0, 0.5, 0.75);
  Solids solids(options);
  const auto field = solids.at(0.0);
  CHECK(field->domain.dim() == Coord(20, 10, 15));
  for (int i = -2; i <= 22; ++i) {
    for (int j = -2; j <= 12; ++j) {
      for (int k = -2; k <= 17; ++k) {
        const Coord c(i, j, k);
        const bool x = i >= 0 && i < 20, y = j >= 0 && j < 10, z = k >= 0 && k < 15;
        REQUIRE(field->open[0].tree().getValue(c) == (i > 0 && x && y && z ? 1.0f : 0.0f));
        REQUIRE(field->open[1].tree().getValue(c) == (j > 0 && x && y && z ? 1.0f : 0.0f));
        REQUIRE(field->open[2].tree().getValue(c) == (k > 0 && x && y && z ? 1.0f : 0.0f));
        REQUIRE((field->phi->tree().getValue(c) > 0.0f) == (x && y && z));
      }
    }
  }
  CHECK_THAT(field->phi->tree().getValue(Coord(0, 5, 7)), WithinAbs(0.025, 1e-7));
  CHECK_THAT(field->phi->tree().getValue(Coord(-1, 5, 7)), WithinAbs(-0.025, 1e-7));
  CHECK_THAT(field->phi->tree().getValue(Coord(10, 5, 7)), WithinAbs(0.15, 1e-7));  // 3 voxels
}

TEST_CASE("solids: a domain that ends inside a cell opens the last layer in part", "[sim]") {
  Options options = tankWith(10);
  options.size = Vec3d(1.0, 0.33, 0.5);
  Solids solids(options);
  const auto field = solids.at(0.0);
  CHECK(field->domain.dim() == Coord(10, 4, 5));
  CHECK_THAT(field->open[0].tree().getValue(Coord(5, 3, 2)), WithinAbs(0.3, 1e-6));
  CHECK(field->open[1].tree().getValue(Coord(5, 3, 2)) == 1.0f);
  CHECK(field->open[1].tree().getValue(Coord(5, 4, 2)) == 0.0f);
}

TEST_CASE("solids: a domain whose size is rounded to six digits is closed at its last faces", "[sim]") {
  Options options = tankWith(27, {});
  options.size = Vec3d(0.962963, 0.740741, 1.0);  // 26.000001, 20.000007 and 27 cells
  const auto field = Solids(options).at(0.0);
  const Coord count = field->domain.max().offsetBy(1);
  CHECK(count[0] == 26);
  CHECK(field->open[0].tree().getValue(Coord(count[0], 5, 5)) == 0.0f);
  CHECK(field->open[1].tree().getValue(Coord(5, count[1], 5)) == 0.0f);
  CHECK(field->open[2].tree().getValue(Coord(5, 5, count[2])) == 0.0f);
}

TEST_CASE("solids: they come and go at their times", "[sim]") {
  const Shape gate{Box{Vec3d(0.4, 0.0, 0.0), Vec3d(0.6, 1.0, 1.0)}};
  Solids solids(tankWith(16, {solidOf(gate, 0.0, 0.5), solidOf(Shape{Sphere{Vec3d(0.2), 0.1}}, 0.25, 1.0),
                              solidOf(gate, 0.8, 0.8)}));
  CHECK(solids.active(0.0) == std::vector<std::size_t>{0});
  CHECK(solids.active(0.25) == std::vector<std::size_t>{0, 1});
  CHECK(solids.active(0.5) == std::vector<std::size_t>{1});
  CHECK(solids.active(1.0).empty());
  CHECK(solids.nextChange(0.0) == 0.25);
  CHECK(solids.nextChange(0.25) == 0.5);
  CHECK(solids.nextChange(0.5) == 1.0);
  CHECK(solids.nextChange(1.0) == kForever);

  const auto first = solids.at(0.0);
  CHECK(solids.at(0.2) == first);  // kept
  const Coord inGate(8, 8, 8);
  CHECK(first->open[0].tree().getValue(inGate) == 0.0f);
  CHECK(first->phi->tree().getValue(inGate) < 0.0f);
  const auto last = solids.at(1.5);
  CHECK(last->open[0].tree().getValue(inGate) == 1.0f);
  CHECK(last->phi->tree().getValue(inGate) > 0.0f);
  CHECK_THAT(solids.distance(Vec3d(0.5, 0.5, 0.5), 0.0), WithinAbs(-0.1, 1e-12));
  CHECK_THAT(solids.distance(Vec3d(0.5, 0.5, 0.5), 1.5), WithinAbs(0.5, 1e-12));
  CHECK_THAT(solids.distance(Vec3d(-0.3, 0.5, 1.4), 1.5), WithinAbs(-0.5, 1e-12));
}

TEST_CASE("solids: how far one reaches behind a side of the domain changes nothing there") {
  const auto shelf = [](double end) {
    Options options;
    options.resolution = 24;
    options.solids.resize(1);
    options.solids[0].shape = {Box{Vec3d(-end, 0.2, 0.3), Vec3d(1.0 + end, 0.29, 2.0)}};
    return Solids(options);
  };
  const Solids near = shelf(2.0 / 24.0), far = shelf(3.0);
  for (int n = 0; n < 24; ++n) {
    const Vec3d x(1.0 + 0.02 * (n % 3), 0.1 + 0.02 * n / 3, 0.5);
    CHECK_THAT(near.distance(x, 0.0), WithinAbs(far.distance(x, 0.0), 1e-12));
  }
  // Straight behind the shelf's middle: as deep as its edge is away.
  CHECK_THAT(near.distance(Vec3d(1.02, 0.245, 0.5), 0.0), WithinAbs(-std::hypot(0.02, 0.045), 1e-12));
}

TEST_CASE("solids: where two touch it is as solid as elsewhere") {
  Options options;
  options.resolution = 16;
  const double h = 1.0 / 16;
  options.solids.resize(2);
  options.solids[0].shape = {Box{Vec3d(0.2, 0.2, 0.2), Vec3d(0.53, 0.8, 0.8)}};
  options.solids[1].shape = {Box{Vec3d(0.53, 0.2, 0.2), Vec3d(0.8, 0.8, 0.8)}};
  const auto field = Solids(options).at(0.0);
  for (int j = 4; j < 12; ++j)
    for (int k = 4; k < 12; ++k) CHECK(field->phi->tree().getValue(Coord(8, j, k)) < -0.49f * float(h));
}

TEST_CASE("solids: where two touch their common surface is as deep as elsewhere") {
  // The joint is at 8.5 cells, so that the centres of a row lie in it; the solids end at 12.07.
  Options options;
  options.resolution = 16;
  const double h = 1.0 / 16, joint = 8.5 * h, end = 12.07 * h;
  options.solids.resize(2);
  options.solids[0].shape = {Box{Vec3d(0.2, 0.2, 0.2), Vec3d(joint, 0.8, end)}};
  options.solids[1].shape = {Box{Vec3d(joint, 0.2, 0.2), Vec3d(0.8, 0.8, end)}};
  const auto field = Solids(options).at(0.0);
  for (int i = 5; i < 12; ++i) {
    CAPTURE(i);
    CHECK(field->phi->tree().getValue(Coord(i, 8, 11)) ==
          Catch::Detail::Approx(i == 8 ? -0.5 * h : -0.57 * h));
    CHECK(field->phi->tree().getValue(Coord(i, 8, 12)) == Catch::Detail::Approx(0.43 * h));
  }
}

TEST_CASE("solids: a joint that a surface crosses in a cell is no surface") {
  Options options;
  options.resolution = 16;
  const double h = 1.0 / 16, joint = 8.5 * h, begin = 4.07 * h;
  options.solids.resize(2);
  options.solids[0].shape = {Box{Vec3d(0.2, 0.2, begin), Vec3d(joint, 0.8, 0.8)}};
  options.solids[1].shape = {Box{Vec3d(joint, 0.2, begin), Vec3d(0.8, 0.8, 0.8)}};
  const auto field = Solids(options).at(0.0);
  for (int i = 5; i < 12; ++i)
    CHECK(field->phi->tree().getValue(Coord(i, 8, 4)) == Catch::Detail::Approx(-0.43 * h).epsilon(0.01));
}

TEST_CASE("solids: in a corner of thin walls cells are as deep as the nearest surface is far") {
  // The walls of a box, 0.92 cells thick. Its corner lies so near cell centres that little room is left there
  // between the walls.
  Options options;
  options.resolution = 16;
  const double h = 1.0 / 16;
  options.solids.resize(1);
  options.solids[0].shape = {Difference{{{Box{Vec3d(5.902, 4.514, 4.951) * h, Vec3d(12.92) * h}},
                                         {Box{Vec3d(6.827, 5.438, 5.875) * h, Vec3d(12.0) * h}}}}};
  const auto field = Solids(options).at(0.0);
  const auto depthAt = [&](const Coord& cell) { return -field->phi->tree().getValue(cell) / h; };
  for (int n = 6; n < 11; ++n) {
    CAPTURE(n);
    CHECK(depthAt(Coord(6, 5, n)) == Approx(0.327).margin(1e-4));
    CHECK(depthAt(Coord(n + 1, 5, 5)) == Approx(0.375).margin(1e-4));
  }
  CHECK(depthAt(Coord(6, 5, 5)) == Approx(std::hypot(0.327, 0.375)).margin(1e-4));
}
