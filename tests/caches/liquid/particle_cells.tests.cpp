#include "caches/liquid/particle_cells.h"

#include "numerics/random.h"
#include "tests/caches/liquid/flows.h"

#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include <map>

using namespace fluidtex;
using namespace fluidtex::caches;
using openvdb::Vec3f;

namespace {

// In a cube of side 1 from (-2, 3, 0) on.
std::vector<Vec3f> scattered(std::uint64_t count) {
  std::vector<Vec3f> points;
  for (std::uint64_t n = 0; n < count; ++n)
    points.emplace_back(float(randomUnit(1, 3 * n) - 2.0), float(randomUnit(1, 3 * n + 1) + 3.0),
                        float(randomUnit(1, 3 * n + 2)));
  return points;
}

// What a window says of those around x, by the given particles' numbers.
std::map<std::uint32_t, double> nearTo(const ParticleCells& cells, const std::vector<Vec3f>& points,
                                       const Vec3d& x, const Vec3d& low, const Vec3d& high) {
  std::map<std::uint32_t, double> found;
  ParticleCells::Window(cells, low, high).near(x, [&](std::uint32_t n, const Vec3d& d, double s) {
    const std::uint32_t particle = cells.order()[n];
    CHECK((x + d - Vec3d(points[particle])).length() < 1e-12);
    CHECK(found.emplace(particle, s).second);  // each once
  });
  return found;
}

}  // namespace

TEST_CASE("particle cells: in the order of their cells, those of one as they were given", "[caches]") {
  const std::vector<Vec3f> points{Vec3f(0.1f, 0, 2.5f), Vec3f(1.5f, 0, 0), Vec3f(0, 1.2f, 0),
                                  Vec3f(0.3f, 0, 0.4f), Vec3f(0, 0, 2.2f), Vec3f(0, 0, 0.9f)};
  const ParticleCells cells(points, 1.0);
  CHECK(cells.reach() == 1.0);
  CHECK(cells.order() == std::vector<std::uint32_t>{3, 5, 0, 4, 2, 1});
}

TEST_CASE("particle cells: all that are nearer than the reach, and no others", "[caches]") {
  const std::vector<Vec3f> points = scattered(2000);
  for (const double reach : {0.07, 0.3, 5.0}) {
    CAPTURE(reach);
    const ParticleCells cells(points, reach);
    const Vec3d low(-2.3, 2.7, -0.3), high(-0.7, 4.3, 1.3);
    for (std::uint64_t place = 0; place < 20; ++place) {
      const Vec3d x = low + Vec3d(1.6 * randomUnit(2, 3 * place), 1.6 * randomUnit(2, 3 * place + 1),
                                  1.6 * randomUnit(2, 3 * place + 2));
      std::map<std::uint32_t, double> expected;
      for (std::uint32_t n = 0; n < points.size(); ++n)
        if (const double s = 1.0 - (Vec3d(points[n]) - x).lengthSqr() / (reach * reach); s > 0.0)
          expected[n] = s;
      for (const double margin : {0.0, 0.1, 3.0}) {
        const auto found = nearTo(cells, points, x, x - Vec3d(margin), x + Vec3d(0.5 * margin));
        REQUIRE(found.size() == expected.size());
        for (const auto& [n, s] : expected) REQUIRE(found.at(n) == Approx(s).margin(1e-9));
      }
    }
  }
}

TEST_CASE("particle cells: a window with no particles around is empty", "[caches]") {
  const ParticleCells cells({Vec3f(0.0f), Vec3f(0.5f, 0, 0), Vec3f(10, 10, 10)}, 1.0);
  using Window = ParticleCells::Window;
  CHECK_FALSE(Window(cells, Vec3d(-0.5), Vec3d(0.5)).empty());
  // What lies in the cells beside those of the box counts.
  CHECK_FALSE(Window(cells, Vec3d(1.9, 0, 0), Vec3d(1.9, 0, 0)).empty());
  CHECK(Window(cells, Vec3d(2.1, 0, 0), Vec3d(8.9, 0, 0)).empty());
  CHECK_FALSE(Window(cells, Vec3d(9.1), Vec3d(9.1)).empty());
  CHECK(Window(cells, Vec3d(20.0), Vec3d(30.0)).empty());
  const ParticleCells none({}, 1.0);
  CHECK(none.order().empty());
  CHECK(Window(none, Vec3d(0.0), Vec3d(1.0)).empty());
}

TEST_CASE("particle cells: one that is very far away takes nothing from the others", "[caches]") {
  std::vector<Vec3f> points = scattered(200);
  points.emplace_back(1e30f, 1e30f, -1e30f);
  points.emplace_back(-1e9f, 0.0f, 1e20f);
  const ParticleCells cells(points, 0.3);
  for (const Vec3d& x : {Vec3d(-1.5, 3.5, 0.5), Vec3d(-1.9, 3.1, 0.9)}) {
    std::size_t count = 0;
    for (const Vec3f& p : points) count += (Vec3d(p) - x).length() < 0.3;
    CHECK(nearTo(cells, points, x, x, x).size() == count);
  }
}

TEST_CASE("particle cells: the same order on one thread and on several", "[caches]") {
  const std::vector<Vec3f> points = scattered(20000);
  const ParticleCells several(points, 0.2);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(ParticleCells(points, 0.2).order() == several.order());
}
