#include "texture/search/search.h"

#include "tests/texture/search/sample_windows.h"
#include "tests/threads.h"
#include "texture/exemplar/window_size.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using fluidtex::randomBelow;
using fluidtex::randomUnit;

namespace {

struct Named {
  const char* name;
  Exemplar exemplar;
};

std::vector<Named> exemplars(int size, bool toroidal) {
  std::vector<Named> result;
  result.push_back({"stripes", makeExemplar(stripes(size), toroidal, {}, 1)});
  result.push_back({"cells", makeExemplar(cells(size), toroidal, {}, 1)});
  result.push_back({"clouds", makeExemplar(clouds(size), toroidal, {}, 1)});
  return result;
}

// The distance by its definition.
double plainDistance(const SearchTable& table, const Image& image, const WindowQuery& query, Vec2i center) {
  const int half = table.window / 2;
  double sum = 0.0, weights = 0.0;
  for (int y = -half; y <= half; ++y)
    for (int x = -half; x <= half; ++x) {
      const std::size_t i = std::size_t((y + half) * table.window + x + half);
      const double weight = double(windowFalloff(table.window, float(x), float(y))) * query.mask[i];
      weights += weight;
      if (weight <= 0.0) continue;
      const float* texel = image.at((center[0] + x + image.width) % image.width,
                                    (center[1] + y + image.height) % image.height);
      for (int c = 0; c < table.channels; ++c) {
        const double difference =
            double(texel[c]) - query.pixels[i * std::size_t(table.channels) + std::size_t(c)];
        sum += weight * difference * difference;
      }
    }
  return sum / weights;
}

Match exhaustive(const SearchTable& table, const WindowQuery& query) {
  Match best;
  for (int y = table.minCenter()[1]; y <= table.maxCenter()[1]; ++y)
    for (int x = table.minCenter()[0]; x <= table.maxCenter()[0]; ++x) {
      const float distance = windowDistance(table, query, {x, y}, best.distance);
      if (distance < best.distance) best = {{x, y}, distance};
    }
  return best;
}

}  // namespace

TEST_CASE("search: the fall-off is one at the centre, even, and falls to a third at the rim", "[texture]") {
  for (const int window : {9, 17, 33}) {
    CHECK(windowFalloff(window, 0, 0) == 1.0f);
    CHECK(windowFalloff(window, 3, -2) == windowFalloff(window, -2, 3));
    CHECK_THAT(windowFalloff(window, float(window) / 2.0f, 0), WithinAbs(std::exp(-9.0 / 8.0), 1e-6));
  }
}

TEST_CASE("search: a window is shortened where the image has become too small", "[texture]") {
  const Image large{64, 80, 1, {}}, small{20, 40, 1, {}}, tiny{1, 1, 1, {}};
  CHECK(fittingWindow(large, false, 33) == 33);
  CHECK(fittingWindow(small, false, 33) == 11);
  CHECK(fittingWindow(small, true, 33) == 19);
  CHECK(fittingWindow(small, false, 9) == 9);
  CHECK(fittingWindow(tiny, false, 9) == 1);
}

TEST_CASE("search: an even window or one that does not fit is refused", "[texture]") {
  const Exemplar exemplar = makeExemplar(clouds(64), false, {}, 1);
  CHECK_THROWS_AS(buildSearchTable(exemplar.match[0], false, 8, 1), std::invalid_argument);
  CHECK_THROWS_AS(buildSearchTable(exemplar.match[0], false, 65, 1), std::invalid_argument);
}

TEST_CASE("search: the distance is its definition's, across edges and with missing pixels", "[texture]") {
  for (const bool toroidal : {false, true})
    for (const int window : {5, 9, 17}) {
      const Exemplar exemplar = makeExemplar(cells(64), toroidal, {}, 1);
      const Image& image = exemplar.match[0];
      const SearchTable table = buildSearchTable(image, toroidal, window, 1);
      WindowQuery query(table);
      for (std::uint64_t n = 0; n < 40; ++n) {
        makeQuery(table, image, Kind::blended, n, query);
        if (n % 2 == 1) {
          for (std::size_t i = 0; i < query.mask.size(); ++i)
            query.mask[i] = float(randomBelow(n, i, 3)) / 2.0f;
          prepareQuery(table, query);
        }
        const Vec2i center = n == 0   ? table.minCenter()
                             : n == 1 ? table.maxCenter()
                                      : randomCenter(table, 7, n);
        const float distance = windowDistance(table, query, center);
        CHECK_THAT(distance, WithinRel(float(plainDistance(table, image, query, center)), 1e-5f));
        // A bound that is not reached changes nothing; one that is, is exceeded.
        CHECK(windowDistance(table, query, center, distance) == distance);
        CHECK(windowDistance(table, query, center, 0.3f * distance) > 0.3f * distance);
      }
    }
}

TEST_CASE("search: what stands in missing pixels does not matter", "[texture]") {
  const Exemplar exemplar = makeExemplar(cells(64), false, {}, 1);
  const SearchTable table = buildSearchTable(exemplar.match[0], false, 9, 1);
  WindowQuery a(table), b(table);
  makeQuery(table, exemplar.match[0], Kind::turned, 1, a);
  for (std::size_t i = 0; i < 30; ++i) a.mask[i] = 0.0f;
  b.mask = a.mask;
  b.pixels = a.pixels;
  for (std::size_t i = 0; i < 30 * std::size_t(table.channels); ++i)
    b.pixels[i] = std::numeric_limits<float>::quiet_NaN();
  prepareQuery(table, a);
  prepareQuery(table, b);
  const Match first = nearestWindow(table, a, {}, 4), second = nearestWindow(table, b, {}, 4);
  CHECK(first.center == second.center);
  CHECK(first.distance == second.distance);
  // And one query may be used with a mask and without in turn.
  WindowQuery fresh(table);
  readWindow(table, exemplar.match[0], {20, 30}, a);
  readWindow(table, exemplar.match[0], {20, 30}, fresh);
  CHECK(a.weight == fresh.weight);
}

TEST_CASE("search: a window of the exemplar is found", "[texture]") {
  for (const bool toroidal : {false, true})
    for (const Named& named : exemplars(128, toroidal)) {
      INFO(named.name);
      const SearchTable table = buildSearchTable(named.exemplar.match[0], toroidal, 9, 1);
      WindowQuery query(table);
      for (std::uint64_t n = 0; n < 50; ++n) {
        readWindow(table, named.exemplar.match[0], randomCenter(table, 3, n), query);
        CHECK(nearestWindow(table, query, {}, 4).distance < 1e-6f);
      }
    }
}

TEST_CASE("search: the result is never farther than the first candidate", "[texture]") {
  for (const Named& named : exemplars(128, false))
    for (const int window : {9, 17, 33}) {
      INFO(named.name << ", window " << window);
      const SearchTable table = buildSearchTable(named.exemplar.match[0], false, window, 1, 4);
      WindowQuery query(table);
      for (std::uint64_t n = 0; n < 60; ++n) {
        makeQuery(table, named.exemplar.match[0], n % 2 ? Kind::blended : Kind::turned, n, query);
        if (n % 3 == 0) {
          for (std::size_t i = 0; i < query.mask.size() / 2; ++i) query.mask[i] = 0.0f;
          prepareQuery(table, query);
        }
        std::vector<Vec2i> candidates;
        for (std::uint64_t k = 0; k < 3; ++k) candidates.push_back(randomCenter(table, 40 + k, n));
        // The best there is as the first candidate: nothing may replace it by something worse.
        if (n % 4 == 0) candidates[0] = exhaustive(table, query).center;
        if (n % 4 == 1) candidates[0] = {-50, 1000};  // made valid
        const float first = windowDistance(table, query, validCenter(table, candidates[0]));
        for (const int probes : {0, 1, 4}) {
          const Match match = nearestWindow(table, query, candidates, probes);
          CHECK(match.distance <= first);
          CHECK(match.distance == windowDistance(table, query, match.center));
          CHECK(match.center == validCenter(table, match.center));
        }
        const Match among = nearestWindow(table, query, candidates, 0);
        for (const Vec2i& candidate : candidates)
          CHECK(among.distance <= windowDistance(table, query, validCenter(table, candidate)));
      }
    }
}

TEST_CASE("search: the mean distance is within 10% of exhaustive search", "[texture]") {
  for (const Named& named : exemplars(128, false))
    for (const int window : {9, 17}) {
      const SearchTable table = buildSearchTable(named.exemplar.match[0], false, window, 1);
      WindowQuery query(table);
      for (const Kind kind : {Kind::turned, Kind::stretched, Kind::noisy, Kind::blended, Kind::blurred}) {
        INFO(named.name << ", window " << window << ", query " << int(kind));
        double found = 0.0, best = 0.0;
        for (std::uint64_t n = 0; n < 60; ++n) {
          makeQuery(table, named.exemplar.match[0], kind, n, query);
          found += nearestWindow(table, query, {}, 4).distance;
          best += exhaustive(table, query).distance;
        }
        CHECK(found >= best);
        CHECK(found <= 1.1 * best);
      }
    }
}

TEST_CASE("search: half a window is enough to find the whole", "[texture]") {
  const Exemplar exemplar = makeExemplar(cells(128), false, {}, 1);
  const SearchTable table = buildSearchTable(exemplar.match[0], false, 17, 1);
  WindowQuery query(table);
  double found = 0.0, best = 0.0;
  for (std::uint64_t n = 0; n < 60; ++n) {
    makeQuery(table, exemplar.match[0], Kind::turned, n, query);
    for (int y = 0; y < 17; ++y)
      for (int x = 0; x < 17; ++x) query.mask[std::size_t(y * 17 + x)] = x + y < 13 ? 0.0f : 1.0f;
    prepareQuery(table, query);
    found += nearestWindow(table, query, {}, 4).distance;
    best += exhaustive(table, query).distance;
  }
  CHECK(found <= 1.25 * best);
}

TEST_CASE("search: a large exemplar is thinned, and still searched well", "[texture]") {
  const Exemplar exemplar = makeExemplar(clouds(512), true, {}, 1);
  const SearchTable table = buildSearchTable(exemplar.match[0], true, 9, 1, 2);
  CHECK(table.stride == 2);
  WindowQuery query(table);
  double found = 0.0, best = 0.0;
  for (std::uint64_t n = 0; n < 20; ++n) {
    makeQuery(table, exemplar.match[0], Kind::turned, n, query);
    found += nearestWindow(table, query, {}, 4).distance;
    best += exhaustive(table, query).distance;
    std::vector<Vec2i> similar(2);
    const Vec2i at = randomCenter(table, 8, n);
    CHECK(similarWindows(table, at, similar) == 2);
    for (const Vec2i& other : similar) CHECK(other == validCenter(table, other));
  }
  CHECK(found <= 1.1 * best);
}

TEST_CASE("search: similar windows are alike, apart, and nearest first", "[texture]") {
  for (const bool toroidal : {false, true}) {
    const Exemplar exemplar = makeExemplar(cells(128), toroidal, {}, 1);
    const SearchTable table = buildSearchTable(exemplar.match[0], toroidal, 9, 1, 6);
    WindowQuery query(table);
    const auto apart = [&](Vec2i a, Vec2i b) {
      int x = std::abs(a[0] - b[0]), y = std::abs(a[1] - b[1]);
      if (toroidal) x = std::min(x, 128 - x), y = std::min(y, 128 - y);
      return std::max(x, y);
    };
    double similarSum = 0.0, randomSum = 0.0;
    for (std::uint64_t n = 0; n < 200; ++n) {
      const Vec2i center = randomCenter(table, 5, n);
      std::vector<Vec2i> similar(6);
      REQUIRE(similarWindows(table, center, similar) == 6);
      readWindow(table, exemplar.match[0], center, query);
      for (std::size_t k = 0; k < similar.size(); ++k) {
        CHECK(similar[k] == validCenter(table, similar[k]));
        if (similar[k] == center) continue;  // fewer than six were found
        CHECK(apart(similar[k], center) >= 4);
        for (std::size_t other = 0; other < k; ++other) CHECK(apart(similar[k], similar[other]) >= 4);
        similarSum += windowDistance(table, query, similar[k]);
        randomSum += windowDistance(table, query, randomCenter(table, 6, 6 * n + k));
      }
      std::vector<Vec2i> two(2);
      CHECK(similarWindows(table, center, two) == 2);
      CHECK(two[0] == similar[0]);
    }
    CHECK(similarSum < 0.4 * randomSum);
  }
}

TEST_CASE("search: in a picture of repeated tiles the similar windows are the tiles' own", "[texture]") {
  Image tiles{64, 64, 1, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      tiles.data.push_back(float(randomUnit(1, std::uint64_t(y % 16 * 16 + x % 16))));
  const SearchTable table = buildSearchTable(tiles, true, 9, 1, 4);
  for (std::uint64_t n = 0; n < 50; ++n) {
    const Vec2i center = randomCenter(table, 5, n);
    std::vector<Vec2i> similar(4);
    REQUIRE(similarWindows(table, center, similar) == 4);
    for (const Vec2i& other : similar) {
      CHECK(other != center);
      CHECK((other[0] - center[0]) % 16 == 0);
      CHECK((other[1] - center[1]) % 16 == 0);
    }
  }
}

TEST_CASE("search: a plain exemplar and one with a single window are searched too", "[texture]") {
  const Image plain{40, 40, 3, std::vector<float>(40 * 40 * 3, 0.25f)};
  const SearchTable table = buildSearchTable(plain, false, 9, 1, 4);
  WindowQuery query(table);
  std::fill(query.pixels.begin(), query.pixels.end(), 0.75f);
  prepareQuery(table, query);
  CHECK_THAT(nearestWindow(table, query, {}, 4).distance, WithinRel(0.75f, 1e-5f));

  const Exemplar exemplar = makeExemplar(clouds(64), false, {}, 1);
  Image cut{9, 9, exemplar.match[0].channels, {}};
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x)
      cut.data.insert(cut.data.end(), exemplar.match[0].at(x, y), exemplar.match[0].at(x, y) + cut.channels);
  const SearchTable single = buildSearchTable(cut, false, 9, 1, 4);
  WindowQuery other(single);
  prepareQuery(single, other);
  CHECK(nearestWindow(single, other, {}, 4).center == Vec2i(4, 4));
}

TEST_CASE("search: numbers that are none give a valid window, and no memory is touched outside",
          "[texture]") {
  const Exemplar exemplar = makeExemplar(clouds(64), false, {}, 1);
  const SearchTable table = buildSearchTable(exemplar.match[0], false, 9, 1);
  WindowQuery query(table);
  std::fill(query.pixels.begin(), query.pixels.end(), std::numeric_limits<float>::quiet_NaN());
  prepareQuery(table, query);
  const Vec2i candidate(30, 31);
  CHECK(nearestWindow(table, query, {}, 4).center ==
        validCenter(table, nearestWindow(table, query, {}, 4).center));
  CHECK(nearestWindow(table, query, std::span(&candidate, 1), 4).center == candidate);
  // All pixels missing: everything is equally near, so the first candidate stays.
  std::fill(query.mask.begin(), query.mask.end(), 0.0f);
  prepareQuery(table, query);
  const Match match = nearestWindow(table, query, std::span(&candidate, 1), 4);
  CHECK(match.center == candidate);
  CHECK(match.distance == 0.0f);
}

TEST_CASE("search: the same table on one thread and on several", "[texture]") {
  const Exemplar exemplar = makeExemplar(cells(128), false, {}, 1);
  const auto build = [&](int threads) {
    return onThreads(threads, [&] { return buildSearchTable(exemplar.match[0], false, 17, 1, 4); });
  };
  const SearchTable one = build(1), several = build(4);
  CHECK(one.basis.component == several.basis.component);
  CHECK(one.basis.offset == several.basis.offset);
  CHECK(one.tree.index == several.tree.index);
  CHECK(one.tree.codes.fine == several.tree.codes.fine);
  CHECK(one.similar == several.similar);
}
