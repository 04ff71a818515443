#include "sim/solids/solids.h"
#include "sim/solids/open_faces.h"

#include "sim/grid/mac_grid.h"
#include "sim/solids/constrain.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace fluidtex::sim;
using Catch::Matchers::WithinAbs;

namespace {

Options tank(int resolution, std::vector<Solid> solids = {}) {
  Options options;
  options.resolution = resolution;
  options.solids = std::move(solids);
  return options;
}

Solid solidOf(Shape shape, double from = 0.0, double until = kForever) {
  Solid solid;
  solid.shape = std::move(shape);
  solid.from = from;
  solid.until = until;
  return solid;
}

}  // namespace

TEST_CASE("open area: exact for straight edges, and complementary", "[sim]") {
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

TEST_CASE("solids: the domain's faces are walls, all else is open", "[sim]") {
  Options options = tank(20);
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
  Options options = tank(10);
  options.size = Vec3d(1.0, 0.33, 0.5);
  Solids solids(options);
  const auto field = solids.at(0.0);
  CHECK(field->domain.dim() == Coord(10, 4, 5));
  CHECK_THAT(field->open[0].tree().getValue(Coord(5, 3, 2)), WithinAbs(0.3, 1e-6));
  CHECK(field->open[1].tree().getValue(Coord(5, 3, 2)) == 1.0f);
  CHECK(field->open[1].tree().getValue(Coord(5, 4, 2)) == 0.0f);
}

TEST_CASE("solids: a domain whose size is rounded to six digits is closed at its last faces", "[sim]") {
  Options options = tank(27, {});
  options.size = Vec3d(0.962963, 0.740741, 1.0);  // 26.000001, 20.000007 and 27 cells
  const auto field = Solids(options).at(0.0);
  const Coord count = field->domain.max().offsetBy(1);
  CHECK(count[0] == 26);
  CHECK(field->open[0].tree().getValue(Coord(count[0], 5, 5)) == 0.0f);
  CHECK(field->open[1].tree().getValue(Coord(5, count[1], 5)) == 0.0f);
  CHECK(field->open[2].tree().getValue(Coord(5, 5, count[2])) == 0.0f);
}

TEST_CASE("solids: open areas of a tilted half-space are exact", "[sim]") {
  const double slope = std::tan(20.0 * std::numbers::pi / 180.0);
  const Vec3d normal(-slope, 0.0, 1.0);
  const int n = 24;
  const double h = 1.0 / n;
  Solids solids(tank(n, {solidOf(Shape{HalfSpace{Vec3d(0.0, 0.0, 0.2), normal}})}));
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

TEST_CASE("solids: closed areas of a sphere sum to its shadow, at second order", "[sim]") {
  const auto shadow = [](int n) {
    Solids solids(tank(n, {solidOf(Shape{Sphere{Vec3d(0.51, 0.49, 0.47), 0.31}})}));
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

TEST_CASE("solids: they come and go at their times", "[sim]") {
  const Shape gate{Box{Vec3d(0.4, 0.0, 0.0), Vec3d(0.6, 1.0, 1.0)}};
  Solids solids(tank(16, {solidOf(gate, 0.0, 0.5), solidOf(Shape{Sphere{Vec3d(0.2), 0.1}}, 0.25, 1.0),
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

TEST_CASE("solids: a wall in the plane of faces closes them", "[sim]") {
  // 0.3 is no multiple of 1/10 in binary.
  Solids solids(tank(10, {solidOf(Shape{Box{Vec3d(0.3, -1.0, -1.0), Vec3d(0.7, 2.0, 0.6)}})}));
  const auto field = solids.at(0.0);
  CHECK(field->open[0].tree().getValue(Coord(3, 5, 2)) == 0.0f);
  CHECK(field->open[0].tree().getValue(Coord(2, 5, 2)) == 1.0f);
  CHECK(field->open[0].tree().getValue(Coord(7, 5, 2)) == 0.0f);
  CHECK(field->open[0].tree().getValue(Coord(3, 5, 6)) == 1.0f);
  CHECK(field->open[2].tree().getValue(Coord(3, 5, 6)) == 0.0f);
  CHECK(field->open[2].tree().getValue(Coord(2, 5, 6)) == 1.0f);
}

TEST_CASE("constrain: closed faces keep the motion along the solid only", "[sim]") {
  const int n = 16;
  const double h = 1.0 / n, angle = 20.0 * std::numbers::pi / 180.0;
  const Vec3d normal(-std::sin(angle), 0.0, std::cos(angle));
  Solids solids(tank(n, {solidOf(Shape{HalfSpace{Vec3d(0.0, 0.0, 0.3), normal}})}));
  const auto field = solids.at(0.0);
  auto phi = makePhi(h, 3 * h);
  phi->tree().fill(openvdb::CoordBBox(Coord(-3), Coord(n + 2)), static_cast<float>(-h), true);
  MaskGrid::Ptr nobody = MaskGrid::create();
  const FaceMasks valid{{MaskGrid::create(), MaskGrid::create(), MaskGrid::create()}};
  const auto speedInto = [&](double sign, const MaskGrid& separating) {
    std::array<FloatGrid::Ptr, 3> c;
    const Vec3d velocity =
        Vec3d(1.0, 0.5, std::tan(angle)) + sign * normal;  // along the slope, and into or off it
    for (int a = 0; a < 3; ++a) {
      c[a] = FloatGrid::create(0.0f);
      c[a]->tree().fill(openvdb::CoordBBox(Coord(-2), Coord(n + 1)), static_cast<float>(velocity[a]), true);
      c[a]->tree().voxelizeActiveTiles();
    }
    constrainToSolids(*c[0], *c[1], *c[2], *phi, *field, valid, separating);
    // A face just below the slope in the middle of the tank, and one in the open.
    const Coord open(8, 8, 14);
    for (int a = 0; a < 3; ++a) REQUIRE_THAT(c[a]->tree().getValue(open), WithinAbs(velocity[a], 1e-6));
    const Coord closed(8, 8, 6);
    REQUIRE(field->open[2].tree().getValue(closed) == 0.0f);
    // All but closed is closed, no more than that.
    int hair = 0, gap = 0;
    for (int i = 3; i < n - 3; ++i) {
      for (int k = 4; k < n - 2; ++k) {
        const Coord face(i, 8, k);
        const float share = field->open[2].tree().getValue(face);
        if (share <= 0.0f || share >= 1.0f) continue;
        const bool same = std::abs(c[2]->tree().getValue(face) - velocity[2]) < 1e-6;
        (share < kLeastOpen ? hair : gap) += 1;
        CHECK(same == (share >= kLeastOpen || (sign > 0.0 && !separating.empty())));
      }
    }
    CHECK(hair > 0);
    CHECK(gap > 0);
    return Vec3d(c[0]->tree().getValue(closed), c[1]->tree().getValue(closed), c[2]->tree().getValue(closed));
  };
  CHECK_THAT(speedInto(-1.0, *nobody).z(), WithinAbs(std::tan(angle), 0.02));
  CHECK_THAT(speedInto(1.0, *nobody).z(), WithinAbs(std::tan(angle), 0.02));
  MaskGrid::Ptr everybody = MaskGrid::create();
  everybody->tree().fill(openvdb::CoordBBox(Coord(-3), Coord(n + 2)), true, true);
  CHECK_THAT(speedInto(-1.0, *everybody).z(), WithinAbs(std::tan(angle), 0.02));
  CHECK_THAT(speedInto(1.0, *everybody).z(), WithinAbs(std::tan(angle) + normal.z(), 1e-6));  // it may leave
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

TEST_CASE("solids: no face leads into what a wall leaves of a cell beyond it") {
  for (const double more : {-0.009, 1e-5, 0.009}) {
    const auto field =
        Solids(tank(16, {solidOf(Shape{Box{Vec3d(-1.0, -1.0, (8.0 + more) / 16), Vec3d(2.0)}})})).at(0.0);
    CAPTURE(more);
    CHECK(field->open[2].tree().getValue(Coord(8, 8, 8)) == 0.0f);
    CHECK(field->open[0].tree().getValue(Coord(8, 8, 8)) == 0.0f);
    CHECK(field->open[0].tree().getValue(Coord(8, 8, 7)) == 1.0f);
  }
}

TEST_CASE("solids: a gap in which no corner of the grid lies is closed") {
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

TEST_CASE("constrain: nothing moves between the two sides of a thin wall") {
  // A wall of 1.8 cells with two centres in it, wherever it ends; the air above it moves off.
  const int n = 16;
  const double h = 1.0 / n, low = GENERATE(7.75, 7.9, 8.0, 8.2, 8.4);
  Solids solids(tank(n, {solidOf(Shape{Box{Vec3d(-1.0, -1.0, low * h), Vec3d(2.0, 2.0, (low + 1.8) * h)}})}));
  const auto field = solids.at(0.0);
  const auto phi = makePhi(h, 6 * h);
  std::array<FloatGrid::Ptr, 3> c;
  for (int a = 0; a < 3; ++a) {
    c[a] = FloatGrid::create(0.0f);
    c[a]->tree().fill(openvdb::CoordBBox(Coord(-2), Coord(n + 1)), a == 2 ? 1.0f : 0.5f, true);
    c[a]->tree().voxelizeActiveTiles();
  }
  const FaceMasks none{{MaskGrid::create(), MaskGrid::create(), MaskGrid::create()}};
  constrainToSolids(*c[0], *c[1], *c[2], *phi, *field, none, *MaskGrid::create());
  CHECK(c[2]->tree().getValue(Coord(8, 8, 9)) == 0.0f);
  CHECK(c[0]->tree().getValue(Coord(8, 8, 9)) == 0.5f);
}
