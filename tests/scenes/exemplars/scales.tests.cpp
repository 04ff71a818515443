#include "scenes/exemplars/scales.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>

namespace fluidtex::exemplars {

namespace {

Scales small() {
  Scales options;
  options.size = 96;
  options.columns = 6;
  options.rows = 8;
  options.samples = 3;
  return options;
}

}  // namespace

TEST_CASE("green scales: the image that ships is the generator's, pixel by pixel", "[scenes]") {
  const Scales options;
  CHECK((shipped("green_scales.png", options.size) == makeGreenScales(options)));
}

TEST_CASE("green scales: the heights that ship are the generator's, high and low, and toroidal", "[scenes]") {
  const Scales options;
  const int size = options.size;
  const Pixels heights = shipped("green_scales_height.png", size, 1);
  CHECK((heights == makeScalesHeight(options)));
  CHECK(std::count_if(heights.begin(), heights.end(), [](int level) { return level < 32; }) >
        size * size / 50);
  CHECK(std::count_if(heights.begin(), heights.end(), [](int level) { return level > 160; }) >
        size * size / 10);
  const auto step = [&](int a, int b) {
    double sum = 0.0;
    for (int i = 0; i < size; ++i)
      sum += std::abs(int(heights[std::size_t(a * size + i)]) - int(heights[std::size_t(b * size + i)]));
    return sum;
  };
  double largest = 0.0;
  for (int row = 0; row + 1 < size; ++row) largest = std::max(largest, step(row, row + 1));
  CHECK(step(size - 1, 0) <= largest);
}

TEST_CASE("green scales: toroidal, the step over each edge is one of the usual steps", "[scenes]") {
  const int size = small().size;
  const Pixels pixels = makeGreenScales(small());
  for (const bool columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < size; ++i) largest = std::max(largest, step(pixels, size, i, i + 1, columns));
    CHECK(step(pixels, size, size - 1, 0, columns) <= largest);
    CHECK(step(pixels, size, size / 2 + 5, 0, columns) > 0.0);
  }
}

TEST_CASE("green scales: the seed alone decides", "[scenes]") {
  Scales other = small();
  CHECK((makeGreenScales(small()) == makeGreenScales(other)));
  other.seed = small().seed + 1;
  CHECK((makeGreenScales(small()) != makeGreenScales(other)));
}

TEST_CASE("green scales: green, neither black nor white, with light and dark", "[scenes]") {
  const Pixels pixels = makeGreenScales(small());
  double sum[3] = {0.0, 0.0, 0.0};
  int darkest = 255, brightest = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    sum[i % 3] += pixels[i];
    if (i % 3 == 1) {
      darkest = std::min(darkest, int(pixels[i]));
      brightest = std::max(brightest, int(pixels[i]));
    }
  }
  CHECK(sum[1] > 1.3 * sum[0]);
  CHECK(sum[0] > sum[2]);
  CHECK(darkest < 60);
  CHECK(brightest > 150);
  CHECK(brightest < 255);
}

TEST_CASE("green scales: a larger picture is the same one, finer", "[scenes]") {
  Scales twice = small();
  twice.size *= 2;
  const int size = small().size;
  const Pixels coarse = makeScalesHeight(small()), fine = makeScalesHeight(twice);
  REQUIRE(coarse.size() == std::size_t(size) * std::size_t(size));
  REQUIRE(fine.size() == 4 * coarse.size());
  double same = 0.0, other = 0.0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      double mean = 0.0;
      for (const int part : {0, 1, 2, 3})
        mean += 0.25 * fine[std::size_t((2 * y + part / 2) * 2 * size + 2 * x + part % 2)];
      same += std::abs(mean - coarse[std::size_t(y * size + x)]);
      other += std::abs(mean - coarse[std::size_t(x * size + y)]);
    }
  }
  CHECK(same / (size * size) < 2.0);
  CHECK(same < 0.05 * other);
}

TEST_CASE("green scales: free ends point down", "[scenes]") {
  // Above the end of a scale its own rim rises slowly; below it the next one lies deep in its shadow.
  const int size = small().size;
  const Pixels heights = makeScalesHeight(small());
  int steepest[2] = {0, 0};  // downwards, upwards
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int here = heights[std::size_t(y * size + x)],
                below = heights[std::size_t((y + 1) % size * size + x)];
      steepest[0] += std::max(0, here - below - 20);
      steepest[1] += std::max(0, below - here - 20);
    }
  }
  CHECK(steepest[0] > 2 * steepest[1]);
}

}  // namespace fluidtex::exemplars
