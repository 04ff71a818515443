#include "texture/labels/ways.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "texture/optimize/matches.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("ways: offsets are mirrored and turned by quarters") {
  const Vec2f l(3, 1);
  CHECK(laid(0, l) == l);
  CHECK(laid(1, l) == Vec2f(-1, 3));
  CHECK(laid(2, l) == Vec2f(-3, -1));
  CHECK(laid(3, l) == Vec2f(1, -3));
  CHECK(laid(kMirrored, l) == Vec2f(-3, 1));
  CHECK(laid(kMirrored + 1, l) == Vec2f(-1, -3));
  CHECK(wayAt({2}, 1) == 2);
  CHECK(wayAt({2, true}, 2) == kMirrored);
  CHECK(countOf({4, true}) == kMostWays);
}

// As a matrix of its own: what a label does with offsets.
Vec2f apply(const Label& label, const Vec2f& l) {
  return label.at(Complexf(l[0], l[1])) - label.texel;
}

TEST_CASE("ways: a label lies as its way does, seen from any axes, stretched or not") {
  for (int i = 0; i < kMostWays; ++i) {
    const Ways all{4, true};
    const Way way = wayAt(all, i);
    const Label label = unstretched({5, 6}, layOf(way));
    CHECK((apply(label, {3, 1}) - laid(way, {3, 1})).length() < 1e-6f);
    CHECK(nearestWay(all, layOf(label, all)) == way);
    const Complexf rotation = std::polar(1.0f, 0.6f), x = product(rotation, Complexf(3, 1));
    const Label seen = unstretched(label.texel, seenFrom(layOf(way), rotation));
    CHECK((apply(seen, {3, 1}) - apply(label, {x.real(), x.imag()})).length() < 1e-5f);
    // Offsets drawn out to 1.3 and 0.8 before.
    const Label drawnOut{
        seen.texel,
        {seen.jacobian[0] * 1.3f, seen.jacobian[1] * 0.8f, seen.jacobian[2] * 1.3f, seen.jacobian[3] * 0.8f}};
    CHECK(nearestWay(all, layOf(drawnOut, all)) == way);
    CHECK(layOf(drawnOut, all).mirrored == layOf(way).mirrored);
    CHECK(isMirrored(drawnOut) == layOf(way).mirrored);
    CHECK_FALSE(layOf(drawnOut, {4}).mirrored);
  }
}

TEST_CASE("ways: what lies in any way finds the nearest") {
  for (int degrees = -180; degrees <= 180; degrees += 15)
    for (const bool mirrored : {false, true}) {
      const Lay lay{std::polar(1.0f, float(degrees * 3.14159265 / 180)), mirrored};
      CHECK(nearestWay({1, false}, lay) == 0);
      CHECK(nearestWay({1, true}, lay) == (mirrored ? kMirrored : 0));
      for (const Ways& ways : {Ways{2}, Ways{4}, Ways{2, true}, Ways{4, true}}) {
        const Way found = nearestWay(ways, lay);
        CHECK(layOf(found).mirrored == (mirrored && ways.mirrored));
        CHECK(found % (4 / ways.turns) == 0);
        for (int i = 0; i < ways.turns; ++i)
          CHECK(conjugateProduct(layOf(found).turn, lay.turn).real() >=
                conjugateProduct(layOf(wayAt(ways, i)).turn, lay.turn).real() - 1e-4f);
      }
    }
}

// The exemplar lies on the surface turned by quarters or mirrored: only in those ways is it found again.
TEST_CASE("ways: windows are matched as the exemplar lies") {
  const OrientedMesh surface = flatBox(40);
  const Image source = blobImage(64, 64, 3, 6.0, 1);
  TexelImage image = makeTexelImage(source, false, 12);
  const SearchTable table = buildSearchTable(source, false, 9, 1);
  for (int truth = 0; truth < kMostWays; ++truth) {
    Values value;
    for (const Vec3f& x : surface.mesh.positions)
      value.push_back(image.sample(Vec2f(31, 31) + laid(Way(truth), Vec2f(x.x() - 20, 20 - x.y()))));
    std::vector<std::uint8_t> wanted;
    for (const Vec3f& x : surface.mesh.positions)
      wanted.push_back(x.z() > 1.9f && (x - Vec3f(20, 20, 2)).length() < 8);
    const HistogramTarget histogram = makeHistogramTarget(image);
    const Level level{surface.view(), image, histogram, {}, wanted};
    Pass pass;
    pass.window = 9;
    pass.table = &table;
    pass.probes = 64;
    for (const Ways& ways : {Ways{1}, Ways{2}, Ways{4}, Ways{1, true}, Ways{4, true}}) {
      image.ways = ways;
      Windows windows = makeWindows(level, pass);
      findFirstMatches(level, pass, value, windows);
      const double before = windows.distance.front();
      for (int iteration = 0; iteration < 4; ++iteration)
        improveMatches(level, pass, iteration, 0.0, value, windows);
      CHECK(windows.distance.front() <= before);
      const bool possible = truth % 4 % (4 / ways.turns) == 0 && (ways.mirrored || truth < kMirrored);
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
