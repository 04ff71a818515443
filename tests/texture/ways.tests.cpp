#include "texture/ways.h"

#include "tests/texture/oriented_mesh.h"
#include "tests/texture/test_images.h"
#include "texture/matches.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("ways: offsets are turned by quarters, and rotations find the nearest") {
  const Vec2f l(3, 1);
  CHECK(laid(0, l) == l);
  CHECK(laid(1, l) == Vec2f(-1, 3));
  CHECK(laid(2, l) == Vec2f(-3, -1));
  CHECK(laid(3, l) == Vec2f(1, -3));
  CHECK(wayAt(2, 1) == 2);
  for (int degrees = -180; degrees <= 180; degrees += 15) {
    const double angle = degrees * 3.14159265 / 180;
    const Complexf turn(float(2 * std::cos(angle)), float(2 * std::sin(angle)));
    CHECK(nearestWay(1, turn) == 0);
    for (const int turns : {2, 4}) {
      const Way found = nearestWay(turns, turn);
      CHECK(found % (4 / turns) == 0);
      for (int i = 0; i < turns; ++i)
        CHECK(conjugateProduct(turnOf(found), turn).real() >=
              conjugateProduct(turnOf(wayAt(turns, i)), turn).real() - 1e-4f);
    }
  }
}

// The exemplar lies on the surface turned by quarters: only with that many turns is it found again.
TEST_CASE("ways: windows are matched as the exemplar lies") {
  const OrientedMesh surface = flatBox(40);
  const Image source = blobImage(64, 64, 3, 6.0, 1);
  const TexelImage image = makeTexelImage(source, false, 12);
  const SearchTable table = buildSearchTable(source, false, 9, 1);
  for (const Way truth : {Way(0), Way(1), Way(2), Way(3)}) {
    Values value;
    for (const Vec3f& x : surface.mesh.positions)
      value.push_back(image.sample(Vec2f(31, 31) + laid(truth, Vec2f(x.x() - 20, 20 - x.y()))));
    std::vector<std::uint8_t> wanted;
    for (const Vec3f& x : surface.mesh.positions)
      wanted.push_back(x.z() > 1.9f && (x - Vec3f(20, 20, 2)).length() < 8);
    const HistogramTarget histogram = makeHistogramTarget(image);
    const Level level{surface.view(), image, histogram, {}, wanted};
    Pass pass;
    pass.window = 9;
    pass.table = &table;
    pass.probes = 64;
    for (const int turns : {1, 2, 4}) {
      Windows windows = makeWindows(level, pass, turns);
      findFirstMatches(level, pass, value, windows);
      const double before = windows.distance.front();
      for (int iteration = 0; iteration < 4; ++iteration)
        improveMatches(level, pass, iteration, 0.0, value, windows);
      CHECK(windows.distance.front() <= before);
      const bool possible = truth % (4 / turns) == 0;
      for (std::size_t p = 0; p < windows.match.size(); ++p) {
        if (!possible) {
          CHECK(windows.distance[p] > 1e-4f);
          continue;
        }
        CHECK(windows.distance[p] < 1e-5f);
        CHECK(windows.way[p] == truth);
      }
    }
  }
}
