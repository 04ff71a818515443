#include "texture/optimize/matches.h"

#include "tests/texture/optimize/laid_exemplar.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;

namespace {

constexpr int kWindow = 9;

// The exemplar on the upper side of a flat box, in one of its variants, and windows on the middle of it.
struct Shown {
  OrientedMesh surface = flatBox(24);
  Source source;
  Way way;
  Vec2f corner{30.0f, 30.0f};
  Values value;
  SearchTable table;

  explicit Shown(const Image& image, Way shownAs = 0)
      : source(image, false), way(shownAs), table(buildSearchTable(source.match, false, kWindow, 1)) {
    source.image.ways = {4, true};
    for (const Vec3f& x : surface.mesh.positions) value.push_back(source.image.sample(texelOf(x)));
  }
  Vec2f texelOf(const Vec3f& x) const { return corner + laid(way, Vec2f(x.x() - 12.0f, 12.0f - x.y())); }
  Vec2f texelAt(std::uint32_t v) const { return texelOf(surface.mesh.positions[v]); }
  Level level() const {
    return {surface.view(), source.image, source.histogram, {}, middle(surface, 6.0f, 24.0f)};
  }
};

Pass passOf(const SearchTable* table, int probes = 4) {
  Pass pass;
  pass.window = kWindow;
  pass.table = table;
  pass.probes = probes;
  pass.seed = 5;
  return pass;
}

Image linearImage() {
  return imageOf(60, 60, 2, [](int x, int y, int c) {
    return c == 0 ? 0.01f * float(x) : 0.002f * float(x) - 0.005f * float(y);
  });
}

}  // namespace

TEST_CASE("matches: windows come with their fall-off, and with pixels only for the tree") {
  const Shown shown(noiseImage(60, 60, 3, 1));
  const Windows windows = makeWindows(shown.level(), passOf(&shown.table));
  const Neighborhoods& n = windows.neighborhoods;
  REQUIRE(n.size() > 4);
  CHECK(windows.pixels.size() == n.size() * kWindow * kWindow);
  REQUIRE(windows.falloff.size() == n.vertex.size());
  REQUIRE((windows.mass.size() == n.size() && windows.match.size() == n.size() &&
           windows.way.size() == n.size() && windows.distance.size() == n.size()));
  for (std::size_t p = 0; p < n.size(); ++p) {
    CHECK(shown.level().wanted[n.center[p]]);
    CHECK(windows.falloff[n.first[p]] == 1.0f);
    double mass = 0.0;
    for (std::uint32_t i = n.first[p]; i < n.first[p + 1]; ++i) {
      const double width = kWindow / 3.0, l2 = double(n.offset[i].lengthSqr());
      CHECK(windows.falloff[i] == Approx(std::exp(-0.5 * l2 / (width * width))).epsilon(1e-4));
      mass += double(windows.falloff[i]);
    }
    CHECK(windows.mass[p] == Approx(mass));
  }
  CHECK(makeWindows(shown.level(), passOf(nullptr)).pixels.empty());
  CHECK(makeWindows(shown.level(), passOf(&shown.table, 0)).pixels.empty());
}

TEST_CASE("matches: a query holds the surface's pixels, turned into the variant that is asked for") {
  const Shown shown(noiseImage(60, 60, 3, 1));
  const Windows windows = makeWindows(shown.level(), passOf(&shown.table));
  WindowQuery query(shown.table);
  for (int i = 0; i < countOf(windows.ways); ++i) {
    const Way way = wayAt(windows.ways, i);
    fillQuery(windows, 2, shown.value, query, 3, way);
    const Vec2f center = shown.texelAt(windows.neighborhoods.center[2]);
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x) {
        const Vec2f to = laid(way, Vec2f(float(x), float(y)));
        const std::size_t at = std::size_t((int(to[1]) + 4) * kWindow + int(to[0]) + 4);
        REQUIRE(query.mask[at] == 1.0f);
        const Float8 texel = shown.source.image.sample(center + Vec2f(float(x), float(y)));
        for (std::size_t c = 0; c < 3; ++c)
          REQUIRE(query.pixels[3 * at + c] == Approx(texel[int(c)]).margin(1e-4));
      }
  }
}

TEST_CASE("matches: the distance is the mean squared difference under the fall-off") {
  // Shifted, a linear image differs by the same everywhere.
  Shown shown(linearImage());
  Windows windows = makeWindows(shown.level(), passOf(nullptr));
  const Vec2f shift(3.0f, -2.0f);
  const float first = 0.01f * 3.0f, second = 0.002f * 3.0f + 0.005f * 2.0f;
  for (std::size_t p = 0; p < windows.match.size(); ++p)
    windows.match[p] = shown.texelAt(windows.neighborhoods.center[p]) + (p % 2 == 0 ? Vec2f(0.0f) : shift);
  measureMatches(shown.source.image, shown.value, windows);
  for (std::size_t p = 0; p < windows.match.size(); ++p) {
    const float expected = p % 2 == 0 ? 0.0f : first * first + second * second;
    CHECK(windows.distance[p] == Approx(expected).epsilon(0.02).margin(1e-6));  // half precision
  }
}

TEST_CASE("matches: what a match predicts beside its centre is laid in its variant") {
  Windows windows;
  windows.match = {{20.0f, 10.0f}, {20.0f, 10.0f}, {20.0f, 10.0f}};
  windows.way = {0, 1, kMirrored};
  CHECK(windows.texelAt(0, {2.0f, 1.0f}) == Vec2f(22.0f, 11.0f));
  CHECK(windows.texelAt(1, {2.0f, 1.0f}) == Vec2f(19.0f, 12.0f));
  CHECK(windows.texelAt(2, {2.0f, 1.0f}) == Vec2f(18.0f, 11.0f));
}

TEST_CASE("matches: the first ones are found where the exemplar is, in whatever variant it is shown") {
  const Way way = GENERATE(Way(0), Way(1), Way(2), Way(3), Way(kMirrored), Way(kMirrored | 3));
  const Shown shown(blobImage(60, 60, 3, 9.0, 4), way);
  Windows windows = makeWindows(shown.level(), passOf(&shown.table));
  findFirstMatches(shown.level(), passOf(&shown.table, 16), shown.value, windows);
  std::size_t right = 0;
  for (std::size_t p = 0; p < windows.match.size(); ++p) {
    const bool same =
        windows.way[p] == way && windows.match[p] == shown.texelAt(windows.neighborhoods.center[p]);
    right += same;
    if (same) CHECK(windows.distance[p] < 1e-5f);
  }
  // The tree is searched in some of its leaves only.
  CHECK(right > 0.9 * double(windows.match.size()));
}

TEST_CASE("matches: what one window knows, all know after some steps") {
  const Way way = GENERATE(Way(0), Way(kMirrored | 1));
  const Shown shown(noiseImage(60, 60, 3, 1), way);
  const Level level = shown.level();
  const Pass pass = passOf(nullptr);
  Windows windows = makeWindows(level, pass);
  const std::size_t knows = windows.match.size() / 2;
  for (std::size_t p = 0; p < windows.match.size(); ++p) {
    const Vec2f right = shown.texelAt(windows.neighborhoods.center[p]);
    windows.match[p] = p == knows ? right : Vec2f(8.0f + float(p % 5), 9.0f);
    windows.way[p] = p == knows ? way : Way(2);
  }
  measureMatches(shown.source.image, shown.value, windows);
  for (int iteration = 0; iteration < 8; ++iteration) {
    const std::vector<float> before = windows.distance;
    improveMatches(level, pass, iteration, 0.0, shown.value, windows);
    for (std::size_t p = 0; p < before.size(); ++p) CHECK(windows.distance[p] <= before[p]);
    // What is said of the matches is true of them.
    Windows measured = windows;
    measureMatches(shown.source.image, shown.value, measured);
    for (std::size_t p = 0; p < before.size(); ++p)
      CHECK(windows.distance[p] == Approx(measured.distance[p]).margin(1e-7));
  }
  for (std::size_t p = 0; p < windows.match.size(); ++p) {
    CHECK(windows.way[p] == way);
    CHECK((windows.match[p] - shown.texelAt(windows.neighborhoods.center[p])).length() < 1e-3f);
  }
}

TEST_CASE("matches: the same steps on one thread and on two") {
  const Shown shown(blobImage(60, 60, 3, 9.0, 4), 1);
  const Pass pass = passOf(&shown.table);
  const auto on = [&](int threads) {
    return onThreads(threads, [&] {
      Windows windows = makeWindows(shown.level(), pass);
      std::fill(windows.match.begin(), windows.match.end(), Vec2f(20.0f, 20.0f));
      measureMatches(shown.source.image, shown.value, windows);
      for (int iteration = 0; iteration < 2; ++iteration)
        improveMatches(shown.level(), pass, iteration, 1.0, shown.value, windows);
      return windows;
    });
  };
  const Windows one = on(1), two = on(2);
  CHECK(one.match == two.match);
  CHECK(one.way == two.way);
  CHECK(one.distance == two.distance);
}
