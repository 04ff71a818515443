#include "tools/stress_scenes/dice.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace fluidtex;
using sim::Vec3d;
using stress::Dice;

namespace {

constexpr int kThrows = 20000;

// Four times what the mean of so many numbers scatters by.
double scatter(double variance) {
  return 4.0 * std::sqrt(variance / kThrows);
}

}  // namespace

TEST_CASE("dice: the numbers are those of SplitMix64, whatever the machine", "[stress]") {
  Dice dice(3, 7);
  CHECK(dice.number(0.0, 1.0) == 0.4170370102967996);
  CHECK(dice.number(0.0, 1.0) == 0.7746204658474619);
  CHECK(dice.number(0.0, 1.0) == 0.09349741508061282);
  CHECK(dice.whole(1, 6) == 5);
  CHECK(dice.whole(0, 1000000000) == 673682118);
  CHECK(dice.number(-2.0, 5.0) == 2.028211101948706);
}

TEST_CASE("dice: another seed or number is another row", "[stress]") {
  const auto first = [](std::uint64_t seed, int number) { return Dice(seed, number).number(0.0, 1.0); };
  CHECK(first(1, 2) == first(1, 2));
  CHECK(first(1, 2) != first(1, 3));
  CHECK(first(1, 2) != first(2, 2));
  CHECK(first(1, 2) != first(2, 1));
  CHECK(first(0, 0) != first(0, 1));
}

TEST_CASE("dice: numbers fill their range evenly", "[stress]") {
  Dice dice(1, 1);
  double sum = 0.0, squares = 0.0;
  for (int n = 0; n < kThrows; ++n) {
    const double x = dice.number(-3.0, 5.0), u = (x + 3.0) / 8.0;
    CHECK((x >= -3.0 && x < 5.0));
    sum += u / kThrows;
    squares += u * u / kThrows;
  }
  CHECK(sum == Approx(0.5).margin(scatter(1.0 / 12.0)));
  CHECK(squares == Approx(1.0 / 3.0).margin(scatter(4.0 / 45.0)));
}

TEST_CASE("dice: whole numbers, both ends among them, come equally often", "[stress]") {
  Dice dice(1, 2);
  std::array<int, 6> count{};
  for (int n = 0; n < kThrows; ++n) ++count.at(std::size_t(dice.whole(-2, 3) + 2));
  for (const int times : count)
    CHECK(double(times) / kThrows == Approx(1.0 / 6.0).margin(scatter(5.0 / 36.0)));
  CHECK(dice.whole(4, 4) == 4);
}

TEST_CASE("dice: a chance is taken as often as it says", "[stress]") {
  Dice dice(1, 3);
  int taken = 0;
  for (int n = 0; n < kThrows; ++n) {
    taken += dice.chance(0.2);
    CHECK_FALSE(dice.chance(0.0));
    CHECK(dice.chance(1.0));
  }
  CHECK(double(taken) / kThrows == Approx(0.2).margin(scatter(0.16)));
}

TEST_CASE("dice: powers are as likely in each power of ten", "[stress]") {
  Dice dice(1, 4);
  std::array<int, 3> count{};
  for (int n = 0; n < kThrows; ++n) {
    const double x = dice.power(0.1, 100.0);
    REQUIRE((x >= 0.0999999 && x < 100.0001));
    ++count[x < 1.0 ? 0 : x < 10.0 ? 1 : 2];
  }
  for (const int times : count)
    CHECK(double(times) / kThrows == Approx(1.0 / 3.0).margin(scatter(2.0 / 9.0)));
}

TEST_CASE("dice: places fill their box, and directions the sphere", "[stress]") {
  Dice dice(1, 5);
  Vec3d place(0.0), mean(0.0), squares(0.0);
  for (int n = 0; n < kThrows; ++n) {
    const Vec3d x = dice.inBox(Vec3d(0.0, 2.0, -1.0), Vec3d(1.0, 4.0, -1.0)), u = dice.direction();
    CHECK((x[0] >= 0.0 && x[0] < 1.0 && x[1] >= 2.0 && x[1] < 4.0 && x[2] == -1.0));
    CHECK(u.length() == Approx(1.0));
    place += x / kThrows;
    mean += u / kThrows;
    squares += u * u / kThrows;
  }
  CHECK(place[0] == Approx(0.5).margin(scatter(1.0 / 12.0)));
  CHECK(place[1] == Approx(3.0).margin(scatter(4.0 / 12.0)));
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(mean[axis] == Approx(0.0).margin(scatter(1.0 / 3.0)));
    CHECK(squares[axis] == Approx(1.0 / 3.0).margin(scatter(4.0 / 45.0)));
  }
}
