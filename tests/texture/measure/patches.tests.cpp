#include "texture/measure/patches.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::texture;
using Catch::Matchers::WithinAbs;

namespace {

// Pictures of independent values about `mean`.
Stack noiseStack(int count, int side, double mean, Dice& dice) {
  Stack stack(count, side, side, 3);
  for (float& value : stack.data) value = float(mean + 0.1 * dice.normal());
  return stack;
}

const auto kAllButItself = [](std::size_t i, std::size_t j) { return i != j; };

}  // namespace

TEST_CASE("measured patches: a pyramid halves while patches fit twice, to three levels at most",
          "[texture]") {
  const auto sides = [](int side) {
    Stack stack(2, side, side + 3, 1);
    std::fill(stack.data.begin(), stack.data.end(), 0.7f);
    std::vector<int> result;
    for (const Stack& level : pyramidOf(stack)) {
      result.push_back(level.height);
      CHECK(level.count == 2);
      CHECK(level.data.size() == std::size_t(2 * level.height * level.width));
      // What is plain stays plain, also at its rim.
      for (const float value : level.data) CHECK_THAT(value, WithinAbs(0.7, 1e-5));
    }
    return result;
  };
  CHECK(sides(47) == std::vector<int>{47, 24, 12});
  CHECK(sides(100) == std::vector<int>{100, 50, 25});
  CHECK(sides(14) == std::vector<int>{14, 7});
  CHECK(sides(13) == std::vector<int>{13});
}

TEST_CASE("measured patches: distances are of each level and width that fits, and least to one's own kind",
          "[texture]") {
  Dice dice(1);
  const PatchJudge judge(pyramidOf(noiseStack(8, 20, 0.5, dice)), 400, dice);
  const PatchDistances own = judge.distances(pyramidOf(noiseStack(8, 20, 0.5, dice)), dice),
                       other = judge.distances(pyramidOf(noiseStack(8, 20, 1.5, dice)), dice);
  std::vector<std::pair<int, int>> keys;
  for (const auto& [key, distance] : own) {
    keys.push_back(key);
    CHECK(distance > 0.0);
    CHECK(other.at(key) > 3.0 * distance);
  }
  CHECK(keys == std::vector<std::pair<int, int>>{{0, 7}, {0, 15}, {1, 7}});
  // Of pictures that are too small there are fewer.
  CHECK(judge.distances(pyramidOf(noiseStack(8, 13, 0.5, dice)), dice).size() == 1);
}

TEST_CASE("measured patches: the ratio is the mean of those to the exemplar's own distances", "[texture]") {
  const std::pair<int, int> narrow{0, 7}, wide{0, 15};
  const std::vector<PatchDistances> own{{{narrow, 0.1}, {wide, 0.2}}, {{narrow, 0.3}, {wide, 0.4}}};
  CHECK_THAT(patchRatio({{narrow, 0.4}, {wide, 0.9}}, own), WithinAbs(2.5, 1e-12));
  CHECK_THAT(patchRatio({{wide, 0.9}}, own), WithinAbs(3.0, 1e-12));
  CHECK(patchRatio({}, own) == 0.0);
  // An exemplar that is everywhere the same gives no measure.
  CHECK_THAT(patchRatio({{narrow, 0.4}}, {{{narrow, 1e-9}}}), WithinAbs(20.0, 1e-9));
}

TEST_CASE("measured patches: windows are reduced to twenty components, which keep what distances they hold",
          "[texture]") {
  constexpr std::size_t kDimension = 30, kCount = 60;
  Dice dice(2);
  // In a space of four directions.
  std::vector<float> axes(4 * kDimension), windows(kCount * kDimension);
  for (float& value : axes) value = float(dice.normal());
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double along = dice.normal();
      for (std::size_t k = 0; k < kDimension; ++k)
        windows[i * kDimension + k] += float(along * double(axes[axis * kDimension + k]));
    }
  const auto apart = [](const std::vector<float>& values, std::size_t dimension, std::size_t i,
                        std::size_t j) {
    double sum = 0.0;
    for (std::size_t k = 0; k < dimension; ++k)
      sum += std::pow(double(values[i * dimension + k]) - double(values[j * dimension + k]), 2);
    return std::sqrt(sum);
  };
  const Reduced reduced = reducedWindows(windows, int(kDimension));
  REQUIRE(reduced.dimension == 20);
  REQUIRE(reduced.values.size() == kCount * 20);
  for (std::size_t i = 1; i < kCount; ++i)
    CHECK_THAT(apart(reduced.values, 20, i, i - 1), WithinAbs(apart(windows, kDimension, i, i - 1), 1e-3));
  CHECK(reducedWindows(std::vector<float>(windows.begin(), windows.begin() + 50), 5).dimension == 5);
}

TEST_CASE("measured patches: a twin is within a fifth of the rms length, and far", "[texture]") {
  // The rms length is 17.4: what differs by less than 3.48 is alike.
  const Reduced windows{1, {10.0f, -10.0f, 10.5f, 30.0f}};
  CHECK(shareWithTwin(windows, 4, kAllButItself) == 0.5);
  CHECK(shareWithTwin(windows, 2, kAllButItself) == 1.0);  // the first and the third are asked
  CHECK(shareWithTwin(windows, 1, kAllButItself) == 1.0);
  CHECK(shareWithTwin(windows, 4, [](std::size_t, std::size_t) { return false; }) == 0.0);
  CHECK(shareWithTwin(windows, 4, [](std::size_t i, std::size_t j) { return i < j; }) == 0.25);
  CHECK(shareWithTwin({1, {10.0f, -10.0f, 13.3f, 30.0f}}, 4, kAllButItself) == 0.5);
  CHECK(shareWithTwin({1, {10.0f, -10.0f, 14.0f, 30.0f}}, 4, kAllButItself) == 0.0);
}
