#include "sim/solids/visibility.h"
#include "sim/surface/level_set.h"
#include "tests/sim/step/solver_scenes.h"

#include "sim/solids/solid_field.h"
#include "sim/solids/solids.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::sim;

namespace {

constexpr int kUp = VisibleCells::kStride[0];

// A plate across x from 0.5 m on, that high, in a tank of 1 m.
Options plate(double thickness, double height, int resolution) {
  Options options = tank(resolution, {});
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.5, -1.0, -1.0), Vec3d(0.5 + thickness, 2.0, height)}};
  return options;
}

// A cup of 0.495 m across and with that much wall, filled to 0.5 m; on a foot as thick as the wall.
Options cup(double wall, int resolution) {
  const Vec3d middle(0.5, 0.5, 0.0);
  const auto at = [&](double z) { return middle + Vec3d(0.0, 0.0, z); };
  Options options = tank(resolution, {{Shape{Cylinder{at(0.2525), at(0.5), 0.2475}}, Vec3d(0.0), 0.0}});
  options.solids.resize(1);
  options.solids[0].shape = {Difference{
      {{Cylinder{at(0.2525 - wall), at(0.6), 0.2475 + wall}}, {Cylinder{at(0.2525), at(0.7), 0.2475}}}}};
  return options;
}

// A box with walls of so many cells, outside of which nothing is, and liquid in it up to `level`, which
// begins in the middle of the walls. All in cells.
struct WalledBox {
  double wall;
  Vec3d low, high;
  double level;
  bool shut;

  static constexpr int kCells = 16;

  Options options() const {
    constexpr double h = 1.0 / kCells;
    const Vec3d half(0.5 * wall), rim(0.0, 0.0, shut ? 0.0 : wall);
    Options options =
        tank(kCells, {box(h * (low - half), h * Vec3d(high[0] + half[0], high[1] + half[1], level))});
    options.solids.resize(1);
    options.solids[0].shape = {Difference{{{Box{h * (low - 2.0 * half), h * (high + 2.0 * half - rim)}},
                                           {Box{h * low, h * (high + 2.0 * rim)}}}}};
    return options;
  }
  // Whether a place lies outside the box.
  bool isOutside(const Vec3d& x) const {
    for (int a = 0; a < 3; ++a) {
      if (x[a] < low[a] - 0.5 * wall || (x[a] > high[a] + 0.5 * wall && (shut || a < 2))) return true;
    }
    return false;
  }
};

}  // namespace

TEST_CASE("visibility: where walls are thick or there are none, all is seen") {
  Options options = tank(16, {});
  CHECK(Solids(options).at(0.0)->visibility == nullptr);
  CHECK(Solids(plate(0.6, 2.0, 16)).at(0.0)->visibility == nullptr);
}

TEST_CASE("visibility: cells on two sides of a wall do not see each other") {
  // From 16 to 17.6 of 32 cells: 16 lies wholly in it, 17 with its centre.
  const auto field = Solids(plate(0.05, 2.0, 32)).at(0.0);
  REQUIRE(field->visibility != nullptr);
  const VisibleCells* before = field->visibility->around(Coord(15, 10, 10));
  REQUIRE(before != nullptr);
  CHECK(before->sees(VisibleCells::kMiddle));
  CHECK(before->sees(VisibleCells::kMiddle - 2 * kUp));
  CHECK(before->sees(VisibleCells::kMiddle + 2 * VisibleCells::kStride[1]));
  CHECK_FALSE(before->sees(VisibleCells::kMiddle + 2 * kUp));
  const VisibleCells* behind = field->visibility->around(Coord(18, 10, 10));
  REQUIRE(behind != nullptr);
  CHECK(behind->sees(VisibleCells::kMiddle + kUp));
  CHECK_FALSE(behind->sees(VisibleCells::kMiddle - 2 * kUp));
}

TEST_CASE("visibility: over a wall's rim one sees the other side, below it one does not") {
  const auto field = Solids(plate(0.025, 0.5, 32)).at(0.0);
  REQUIRE(field->visibility != nullptr);
  CHECK(field->visibility->around(Coord(15, 10, 20)) == nullptr);
  const VisibleCells* below = field->visibility->around(Coord(15, 10, 14));
  REQUIRE(below != nullptr);
  CHECK_FALSE(below->sees(VisibleCells::kMiddle + 2 * kUp));
}

TEST_CASE("visibility: a level set goes on linearly behind a wall, and does not change its sign there") {
  VisibleCells visible;
  for (int j = 0; j < 25; ++j)
    for (const int i : {3, 4}) visible.hide(i * kUp + j);
  Stencil values;
  for (int at = 0; at < VisibleCells::kCount; ++at) values[at] = 5.0f + float(at / kUp);
  for (int at = 3 * kUp; at < VisibleCells::kCount; ++at) values[at] = -100.0f;
  extrapolateBehind(values, visible, 0.55f);
  CHECK(values[VisibleCells::kMiddle + kUp] == 8.0f);
  CHECK(values[VisibleCells::kMiddle + 2 * kUp] == 9.0f);
  for (int at = 0; at < VisibleCells::kCount; ++at) values[at] = 2.5f - float(at / kUp);
  extrapolateBehind(values, visible, 0.55f);  // 2.5, 1.5, 0.5 to the middle
  CHECK(values[VisibleCells::kMiddle + kUp] == 0.5f);
  // Liquid that the wall cuts, and liquid that has separated from it.
  for (int at = 0; at < VisibleCells::kCount; ++at) values[at] = -0.5f + 0.2f * float(at / kUp - 2);
  extrapolateBehind(values, visible, 0.55f);
  CHECK(values[VisibleCells::kMiddle + kUp] == Approx(-0.3f));
  CHECK(values[VisibleCells::kMiddle + 2 * kUp] == Approx(-0.1f));
  for (int at = 0; at < VisibleCells::kCount; ++at) values[at] = float(at / kUp) - 2.1f;
  extrapolateBehind(values, visible, 0.55f);
  CHECK(values[VisibleCells::kMiddle + kUp] == Approx(0.9f));
}

TEST_CASE("visibility: behind a surface that lies on the wall and leaves it there is air") {
  VisibleCells visible;
  for (int j = 0; j < 25; ++j)
    for (const int i : {3, 4}) visible.hide(i * kUp + j);
  Stencil values;
  for (int at = 0; at < VisibleCells::kCount; ++at) values[at] = 0.7f - 0.4f * float(at / kUp);
  riseBehind(values, visible, 1.0f);
  // By as much everywhere along the wall.
  for (int j = 0; j < 25; ++j) {
    CHECK(values[2 * kUp + j] == Approx(-0.1f));
    CHECK(values[3 * kUp + j] == Approx(0.9f));
    CHECK(values[4 * kUp + j] == Approx(1.9f));
  }
}

TEST_CASE("visibility: in a corner of walls the air rises along both") {
  VisibleCells visible;
  for (int at = 0; at < VisibleCells::kCount; ++at)
    if (at / kUp >= 3 || at % 5 >= 3) visible.hide(at);
  Stencil values;
  values.fill(-0.2f);
  riseBehind(values, visible, 1.0f);
  CHECK(values[VisibleCells::kMiddle + kUp] == Approx(0.8f));
  CHECK(values[VisibleCells::kMiddle + 1] == Approx(0.8f));
  CHECK(values[VisibleCells::kMiddle + kUp + 1] == Approx(1.8f));
}

TEST_CASE("visibility: closed cups with walls of 0.6 cells and more hold what is in them") {
  // 2.1, 1.05, 0.63 and 0.6 cells.
  const auto [wall, resolution] =
      GENERATE(std::pair(0.0525, 40), std::pair(0.0525, 20), std::pair(0.0525, 12), std::pair(0.03, 20));
  CAPTURE(wall, resolution);
  Options options = cup(wall, resolution);
  Solver solver(options);
  CHECK(solver.warnings().empty());
  const double first = solver.next().stats.volume, h = options.voxelSize();
  for (int n = 0; n < 24; ++n) {
    const Frame frame = solver.next();
    REQUIRE(std::abs((frame.stats.volume + frame.stats.deficit) / first - 1.0) < 3e-3);
    // What is poured into a cup of six cells across is not level at its wall, and sloshes.
    REQUIRE(std::abs(frame.stats.volume / first - 1.0) < (resolution < 40 ? 0.03 : 0.005));
  }
  const auto solid = Solids(options).at(0.0);
  int outside = 0;
  const auto& phi = solver.state().phi->tree();
  for (auto leaf = phi.cbeginLeaf(); leaf; ++leaf) {
    for (auto it = leaf->cbeginValueAll(); it; ++it) {
      const Vec3d x = (it.getCoord().asVec3d() + Vec3d(0.5)) * h;
      const bool beyond =
          std::hypot(x[0] - 0.5, x[1] - 0.5) > 0.2475 + 0.5 * wall || x[2] < 0.2525 - 0.5 * wall;
      outside += *it < 0.0f && beyond && solid->phi->tree().getValue(it.getCoord()) > 0.0f;
    }
  }
  CHECK(outside == 0);
}

TEST_CASE("visibility: a cell in a corner of thin walls is on the side of its open faces") {
  // A cavity in a block; a cell is a metre. The block's face above y is nearer to the corner's cell than the
  // cavity, and nearer to it than to the cells beside it, as the face is inclined by a little.
  const Vec3d low(4.867, 3.660, 3.941), high(9.524, 9.021, 8.815);
  const auto distance = [&](const Vec3d& x) {
    Vec3d out;
    for (int a = 0; a < 3; ++a) out[a] = std::max(low[a] - x[a], x[a] - high[a]);
    const double deepest = std::max({out[0], out[1], out[2]});
    const double cavity = deepest < 0.0 ? deepest : openvdb::math::maxComponent(out, Vec3d(0.0)).length();
    const double above = x[1] - 9.993 - 0.002 * (x[0] + x[2] - 8.0);
    return std::max({above, 3.9 - x[0], 2.7 - x[1], 2.97 - x[2], x[0] - 10.5, x[2] - 9.8, -cavity});
  };
  const CoordBBox domain = firstCells(Coord(16));
  const SolidField solid =
      makeSolidField(distance, distance, {}, domain, chunksIn(grown(domain, kSolidMargin)), 1.0);
  const Coord corner(4, 9, 3);
  REQUIRE(solid.phi->tree().getValue(corner) == Approx(-0.493).margin(1e-3));
  REQUIRE(solid.phi->tree().getValue(corner.offsetBy(1, 0, 0)) < -0.494f);
  REQUIRE(solid.open[0].tree().getValue(corner.offsetBy(1, 0, 0)) > 0.0f);
  CHECK(solid.visibility->hides(corner, Coord(4, 10, 3)));
  CHECK_FALSE(solid.visibility->hides(corner, Coord(5, 8, 4)));
}

TEST_CASE("visibility: nothing comes out of the corners of boxes with walls of 0.7 cells to one") {
  const WalledBox walls =
      GENERATE(WalledBox{0.810, Vec3d(3.872, 3.569, 3.612), Vec3d(8.380, 7.624, 9.609), 6.538, false},
               WalledBox{0.711, Vec3d(4.496, 4.928, 4.444), Vec3d(8.310, 9.611, 9.240), 6.969, true},
               WalledBox{0.813, Vec3d(4.441, 4.011, 4.856), Vec3d(9.378, 8.371, 9.515), 6.889, false},
               WalledBox{0.969, Vec3d(4.867, 3.660, 3.941), Vec3d(9.524, 9.021, 8.815), 6.945, false});
  CAPTURE(walls.wall);
  Solver solver(walls.options());
  const FrameStats first = solver.next().stats;
  for (int n = 0; n < 7; ++n) {
    const FrameStats stats = solver.next().stats;
    CHECK(stats.volume + stats.deficit == Approx(first.volume + first.deficit).epsilon(1e-4));
    const State& state = solver.state();
    double fastest = 0.0;
    int outside = 0;
    for (auto it = state.phi->cbeginValueOn(); it; ++it) {
      if (*it >= 0.0f) continue;
      outside += walls.isOutside(it.getCoord().asVec3d() + Vec3d(0.5));
      for (const auto& component : state.velocity.component)
        fastest = std::max(fastest, double(std::abs(component->tree().getValue(it.getCoord()))));
    }
    CHECK(outside == 0);
    CHECK(fastest < 0.03 * std::sqrt(9.81 / WalledBox::kCells));
    double due = 0.0;
    if (state.deficit != nullptr) {
      for (auto it = state.deficit->cbeginValueOn(); it; ++it)
        if (walls.isOutside(it.getCoord().asVec3d() + Vec3d(0.5))) due += std::abs(*it);
    }
    CHECK(due < 1e-3);
  }
}

TEST_CASE("visibility: liquid that falls off the underside of a thin floor draws none out of it") {
  // A trough with walls of 1.7 cells, and a slab that hangs below it.
  const double wall = 1.7 / 24.0, bottom = 13.4 / 24.0;
  Options options = tank(24, {box(Vec3d(0.3, 0.3, bottom), Vec3d(0.7, 0.7, 0.7)),
                              box(Vec3d(0.25, 0.25, 0.3), Vec3d(0.75, 0.75, bottom - wall))});
  Solid trough;
  trough.shape = {
      Difference{{{Box{Vec3d(0.3 - wall, 0.3 - wall, bottom - wall), Vec3d(0.7 + wall, 0.7 + wall, 0.9)}},
                  {Box{Vec3d(0.3, 0.3, bottom), Vec3d(0.7, 0.7, 1.0)}}}}};
  options.solids.push_back(trough);
  Solver solver(options);
  const FrameStats first = solver.next().stats;
  for (int n = 0; n < 5; ++n) {
    const FrameStats stats = solver.next().stats;
    REQUIRE(stats.volume + stats.deficit == Approx(first.volume + first.deficit).epsilon(1e-4));
    REQUIRE(std::abs(stats.deficit) < 0.03 * stats.volume);
  }
  // What is in the trough is still there, and none is left below its floor.
  const auto phi = solver.state().phi->getConstUnsafeAccessor();
  for (int i = 9; i < 15; ++i) {
    for (int j = 9; j < 15; ++j) {
      CHECK(phi.getValue(Coord(i, j, 14)) < 0.0f);
      CHECK(phi.getValue(Coord(i, j, 10)) > 0.0f);
    }
  }
}

TEST_CASE("visibility: a pool behind a thin wall does not feel the flow on its other side") {
  // Along the wall, at a metre a second and up to twice that where it piles up. Wherever the wall stands in
  // its cells; in cells: 0.6 has samples of velocity on both sides of it and none in it, 1.2 one or two.
  constexpr int kCells = 16;
  constexpr double h = 1.0 / kCells;
  for (const double viscosity : {0.0, 1.0}) {
    for (const double thickness : {0.6, 1.2}) {
      for (const double middle : {8.0, 8.3, 8.5}) {
        const double low = (middle - 0.5 * thickness) * h, high = (middle + 0.5 * thickness) * h;
        Options options = tank(kCells, {box(Vec3d(0.0), Vec3d(low, 1.0, 0.5)),
                                        box(Vec3d(high, 0.0, 0.0), Vec3d(1.0, 1.0, 0.5))});
        options.viscosity = viscosity;
        options.liquid[1].velocity = Vec3d(0.0, 1.0, 0.0);
        options.solids.resize(1);
        options.solids[0].shape = {Box{Vec3d(low, -1.0, -1.0), Vec3d(high, 2.0, 2.0)}};
        Solver solver(options);
        const Solids solids(options);
        double still = 0.0, flowing = 0.0;
        for (int n = 0; n < 6; ++n) {
          solver.next();
          const State& state = solver.state();
          for (auto it = state.phi->cbeginValueOn(); it; ++it) {
            const Vec3d x = state.phi->indexToWorld(it.getCoord());
            if (*it >= 0.0f || solids.distance(x, 0.0) <= 0.0) continue;
            for (const auto& component : state.velocity.component) {
              double& fastest = x[0] < middle * h ? still : flowing;
              fastest = std::max(fastest, double(std::abs(component->tree().getValue(it.getCoord()))));
            }
          }
        }
        CAPTURE(viscosity, thickness, middle);
        CHECK(flowing > 1.0);
        CHECK(still < 0.002);
      }
    }
  }
}

TEST_CASE("visibility: liquid at rest between thin walls stays so, whatever meets there", "[slow]") {
  struct Case {
    const char* name;
    Options options;
  };
  std::vector<Case> cases;
  const auto add = [&](const char* name, int resolution, const Vec3d& size, Shape solid,
                       Shape liquid) -> Options& {
    Options options = tank(resolution, {{std::move(liquid)}});
    options.size = size;
    options.solids.resize(1);
    options.solids[0].shape = std::move(solid);
    cases.push_back({name, std::move(options)});
    return cases.back().options;
  };
  const auto within = [](const Shape& outer, const Shape& inner) {
    return Shape{Difference{{outer, inner}}};
  };
  add("shut box, walls of 1.6 cells", 25, Vec3d(0.604984, 1.0, 0.628724),
      within({Box{Vec3d(0.0806881, 0.235348, 0.254905), Vec3d(0.333457, 0.92355, 0.623007)}},
             {Box{Vec3d(0.14388, 0.29854, 0.318098), Vec3d(0.270265, 0.860358, 0.559815)}}),
      {Box{Vec3d(0.14388, 0.29854, 0.318098), Vec3d(0.270265, 0.860358, 0.440231)}});
  add("divider that ends behind the domain's sides", 30, Vec3d(1.0, 0.466667, 0.766667),
      {Box{Vec3d(-0.0333333, 0.159746, -0.0333333), Vec3d(1.03333, 0.232195, 0.776513)}},
      {Box{Vec3d(0.0), Vec3d(1.0, 0.195971, 0.392809)}});
  add("round cup, wall of 0.67 cells, poured half into it", 28, Vec3d(0.713941, 0.806144, 1.0),
      within({Cylinder{Vec3d(0.280298, 0.588626, -0.0357143), Vec3d(0.280298, 0.588626, 0.728664), 0.126608}},
             {Cylinder{Vec3d(0.280298, 0.588626, 0.166563), Vec3d(0.280298, 0.588626, 0.764379), 0.102585}}),
      {Cylinder{Vec3d(0.280298, 0.588626, 0.154552), Vec3d(0.280298, 0.588626, 0.538298), 0.114597}});
  add("shut box, walls of 1.7 cells, three cells deep", 27, Vec3d(1.0, 0.574684, 0.762249),
      within({Box{Vec3d(0.0361692, 0.319417, 0.0112169), Vec3d(0.794923, 0.574488, 0.521739)}},
             {Box{Vec3d(0.099937, 0.383184, 0.0749847), Vec3d(0.731155, 0.51072, 0.457971)}}),
      {Box{Vec3d(0.099937, 0.383184, 0.0749847), Vec3d(0.731155, 0.51072, 0.170491)}});
  for (Case& each : cases) {
    CAPTURE(each.name);
    each.options.viscosity = 0.0;
    Solver solver(each.options);
    const double poured = solver.next().stats.volume;
    for (int n = 0; n < 15; ++n) {
      const FrameStats stats = solver.next().stats;
      REQUIRE(std::abs(stats.volume / poured - 1.0) < 0.01);
      const State& state = solver.state();
      const auto phi = state.phi->getConstUnsafeAccessor();
      double energy = 0.0;
      for (const FloatGrid::Ptr& grid :
           {state.velocity.component[0], state.velocity.component[1], state.velocity.component[2]}) {
        for (auto it = grid->cbeginValueOn(); it; ++it)
          if (phi.getValue(it.getCoord()) < 0.0f) energy += 0.5 * double(*it) * *it;
      }
      // A ripple of a cell's height falls at sqrt(g h).
      const double ripple = 9.81 * each.options.voxelSize();
      REQUIRE(energy / static_cast<double>(stats.cells) < 1e-4 * ripple);
    }
  }
}
