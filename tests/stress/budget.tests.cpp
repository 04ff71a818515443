#include "tools/stress_scenes/budget.h"

#include "tests/stress/tank.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace fluidtex;
using sim::Vec3d;
using stress::addSolid;
using stress::boxShape;
using stress::Surroundings;
using stress::tank;

namespace {

constexpr double kCell = 0.05;  // of the tanks

// A tank of 0.4 m3, and what a budget says of it.
struct Pool {
  sim::Options options = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.4)));

  // Of that volume at the time `to`, after what was poured was there at `from`.
  double after(double from, double to, double volume) const {
    const Surroundings surroundings(options, {});
    stress::VolumeBudget budget(options, surroundings);
    CHECK(budget.start(surroundings.pouredVolume()) == 0.0);
    return budget.advance(from, to, volume);
  }
};

}  // namespace

TEST_CASE("volume budget: what comes and goes is allowed, and no more", "[stress]") {
  sim::Options options = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.4)));
  options.liquid.push_back({boxShape(Vec3d(0.3, 0.3, 0.6), Vec3d(0.7, 0.7, 0.8)), Vec3d(0.0), 0.5});
  const Surroundings surroundings(options, {});
  stress::VolumeBudget budget(options, surroundings);
  CHECK(budget.start(0.4) == 0.0);
  CHECK(budget.advance(0.0, 0.25, 0.4) == 0.0);
  CHECK(budget.advance(0.25, 0.5, 0.432) == 0.0);  // the second body
  CHECK(budget.advance(0.5, 0.75, 0.45) == Approx(0.018).epsilon(0.02));
  CHECK(budget.advance(0.75, 1.0, 0.42) == Approx(-0.012).epsilon(0.02));
  // Through a drain liquid goes for good.
  options.drains.push_back({boxShape(Vec3d(0.0), Vec3d(0.1))});
  stress::VolumeBudget drained(options, surroundings);
  drained.start(0.4);
  CHECK(drained.advance(0.0, 0.1, 0.3) == 0.0);
  CHECK(drained.advance(0.1, 0.2, 0.33) == Approx(0.03).epsilon(0.02));
}

TEST_CASE("volume budget: a source must give no more than its room holds", "[stress]") {
  // Walls part the tank. On the source's side there is room for 0.5 x 1 x 0.2 m3, less its own 0.4 x 0.4 x
  // 0.1.
  sim::Options options = tank(boxShape(Vec3d(0.0), Vec3d(1.0, 1.0, 0.8)));
  addSolid(options, boxShape(Vec3d(0.5, -1.0, -1.0), Vec3d(0.7, 2.0, 2.0)));
  sim::Source source;
  source.shape = boxShape(Vec3d(0.05, 0.3, 0.9), Vec3d(0.45, 0.7, 1.0));
  source.velocity = Vec3d(0.0, 0.0, -1.0);
  options.sources.push_back(source);
  const Surroundings surroundings(options, {});
  CHECK(surroundings.roomFor(0) == Approx(0.084).epsilon(0.03));
  const double before = 0.8 * 0.8 + 0.016, full = before + 0.084, step = 0.5 * 0.16;
  const auto after = [&](double first, double second) {
    stress::VolumeBudget budget(options, surroundings);
    budget.start(before);
    CHECK(budget.advance(0.0, 0.5, first) == 0.0);
    return budget.advance(0.5, 1.0, second);
  };
  CHECK(after(before + step, full) == 0.0);
  CHECK(after(before + step, full - 0.05) < 0.0);
}

TEST_CASE("volume budget: as much must be poured as the shapes hold, within what cells can know",
          "[stress]") {
  const sim::Options options = Pool().options;
  const Surroundings surroundings(options, {});
  const double poured = surroundings.pouredVolume();
  // A hundredth, a cell, and some hundredths of a cell of the surface.
  const double allowed = 0.01 * poured + kCell * kCell * kCell + 0.05 * kCell * surroundings.pouredSurface();
  const auto start = [&](double volume) { return stress::VolumeBudget(options, surroundings).start(volume); };
  CHECK(start(poured) == 0.0);
  CHECK(start(poured - 0.99 * allowed) == 0.0);
  CHECK(start(poured - 1.01 * allowed) == Approx(-1.01 * allowed));
  CHECK(start(poured + 0.95 * allowed) == 0.0);
  CHECK(start(poured + 1.05 * allowed) == Approx(1.05 * allowed));
}

TEST_CASE("volume budget: what flows away from the first step on may be missing at once", "[stress]") {
  sim::Options options = Pool().options;
  options.drains.push_back({boxShape(Vec3d(0.0), Vec3d(0.4))});  // 0.064 m3
  const auto start = [&](double volume) {
    const Surroundings surroundings(options, {});
    return stress::VolumeBudget(options, surroundings).start(volume);
  };
  CHECK(start(0.336) == 0.0);
  CHECK(start(0.32) < 0.0);
  options.drains[0].from = 0.1;
  CHECK(start(0.336) < 0.0);
}

TEST_CASE("volume budget: the tolerance goes by the most there has been", "[stress]") {
  const sim::Options options = Pool().options;
  const Surroundings surroundings(options, {});
  stress::VolumeBudget budget(options, surroundings);
  budget.start(0.41);
  CHECK(budget.most() == 0.41);
  CHECK(budget.tolerance() == Approx(0.0041 + kCell * kCell * kCell));
  budget.advance(0.0, 0.1, 0.5);
  budget.advance(0.1, 0.2, 0.3);
  CHECK(budget.most() == 0.5);
  CHECK(budget.tolerance() == Approx(0.005 + kCell * kCell * kCell));
}

TEST_CASE("volume budget: through an open side liquid goes, through a stream's it comes too", "[stress]") {
  Pool pool;
  CHECK(pool.after(0.0, 0.1, 0.1) < 0.0);
  pool.options.sides[1] = sim::Side::open;
  CHECK(pool.after(0.0, 0.1, 0.0) == 0.0);
  CHECK(pool.after(0.0, 0.1, 0.5) == Approx(0.1).epsilon(0.01));
  pool.options.sides[1] = sim::Side::stream;
  CHECK(pool.after(0.0, 0.1, 0.0) == 0.0);
  CHECK(pool.after(0.0, 0.1, 1.0) == 0.0);
}

TEST_CASE("volume budget: a solid that appears takes what is where it stands", "[stress]") {
  Pool pool;
  addSolid(pool.options, boxShape(Vec3d(0.2, 0.2, -1.0), Vec3d(0.6, 0.6, 0.7)));  // in 0.064 m3 of it
  pool.options.solids[0].from = 0.5;
  CHECK(pool.after(0.25, 0.49, 0.336) == Approx(-0.064).epsilon(0.05));
  // It may be in the air above as well: no less is missing than all of the solid in the domain.
  CHECK(pool.after(0.25, 0.5, 0.4 - 0.112) == 0.0);
  CHECK(pool.after(0.25, 0.5, 0.4 - 0.112 - 0.02) == Approx(-0.02).epsilon(0.05));
}

TEST_CASE("volume budget: a source gives its front times its speed and rate, as long as it runs",
          "[stress]") {
  Pool pool;
  sim::Source source;
  source.shape = boxShape(Vec3d(0.3, 0.3, 0.8), Vec3d(0.7, 0.7, 0.9));  // a front of 0.16 m2
  source.velocity = Vec3d(0.0, 0.0, -1.0);
  source.until = 1.0;
  source.rate = {{0.0, 0.0}, {0.5, 1.0}, {0.75, 1.0}};
  pool.options.sources.push_back(source);
  const Surroundings surroundings(pool.options, {});
  const double before = surroundings.pouredVolume();
  CHECK(before == Approx(0.416).epsilon(0.01));
  const auto outsideAfter = [&](double from, double to, double change) {
    stress::VolumeBudget budget(pool.options, surroundings);
    CHECK(budget.start(before) == 0.0);
    return budget.advance(from, to, before + change);
  };
  // A quarter in the mean while it rises, then all of it, then none.
  for (const auto& [from, to, given] : {std::array{0.0, 0.5, 0.04}, std::array{0.75, 1.0, 0.04},
                                        std::array{0.875, 1.5, 0.02}, std::array{1.0, 1.5, 0.0}}) {
    CAPTURE(from, to);
    CHECK(outsideAfter(from, to, given) == 0.0);
    CHECK(outsideAfter(from, to, given + 0.04) == Approx(0.04).epsilon(0.05));
    CHECK(outsideAfter(from, to, given - 0.04) == Approx(-0.04).epsilon(0.05));
  }
}

TEST_CASE("volume budget: what happens at the second frame's time belongs to it, not to the next",
          "[stress]") {
  CHECK(stress::happens(0.4, 0.25, 0.5, 4.0));
  CHECK(stress::happens(0.5, 0.25, 0.5, 4.0));
  CHECK_FALSE(stress::happens(0.25, 0.25, 0.5, 4.0));
  CHECK_FALSE(stress::happens(0.6, 0.25, 0.5, 4.0));
  CHECK_FALSE(stress::happens(0.1, 0.25, 0.5, 4.0));
  // Times that differ by rounding are one.
  for (const double rounding : {-1e-9, 1e-9}) {
    CHECK(stress::happens(0.5 + rounding, 0.25, 0.5, 4.0));
    CHECK_FALSE(stress::happens(0.5 + rounding, 0.5, 0.75, 4.0));
  }
}
