#include "scenes/exemplars/pattern.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace fluidtex::exemplars {

TEST_CASE("pattern: random numbers fill 0 to 1, another one for each argument", "[scenes]") {
  std::set<double> seen;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    for (std::uint64_t a = 0; a < 8; ++a) {
      for (std::uint64_t b = 0; b < 8; ++b) {
        for (std::uint64_t c = 0; c < 8; ++c) {
          const double value = random(seed, a, b, c);
          CHECK((value >= 0.0 && value < 1.0));
          seen.insert(value);
          sum += value;
          squares += value * value;
        }
      }
    }
  }
  CHECK(seen.size() == 4096);
  // Four times what these means scatter by.
  CHECK(sum / 4096.0 == Approx(0.5).margin(4.0 * std::sqrt(1.0 / 12.0 / 4096.0)));
  CHECK(squares / 4096.0 == Approx(1.0 / 3.0).margin(4.0 * std::sqrt(4.0 / 45.0 / 4096.0)));
}

TEST_CASE("pattern: smooth is flat at both ends and odd about its middle, falling too", "[scenes]") {
  CHECK(smooth(2.0, 4.0, 1.0) == 0.0);
  CHECK(smooth(2.0, 4.0, 2.0) == 0.0);
  CHECK(smooth(2.0, 4.0, 3.0) == 0.5);
  CHECK(smooth(2.0, 4.0, 2.5) == Approx(0.15625));  // 3 t^2 - 2 t^3
  CHECK(smooth(2.0, 4.0, 4.0) == 1.0);
  CHECK(smooth(2.0, 4.0, 9.0) == 1.0);
  CHECK(smooth(2.0, 4.0, 2.001) < 1e-6);
  for (const double x : {1.0, 2.3, 2.9, 3.4, 5.0}) {
    CHECK(smooth(2.0, 4.0, x) + smooth(2.0, 4.0, 6.0 - x) == Approx(1.0));
    CHECK(smooth(4.0, 2.0, x) == Approx(1.0 - smooth(2.0, 4.0, x)));
  }
}

TEST_CASE("pattern: colours are mixed channel by channel", "[scenes]") {
  const Color a{1.0, 2.0, 3.0}, b{5.0, 0.0, 3.0};
  CHECK(mixed(a, b, 0.0) == a);
  CHECK(mixed(a, b, 1.0) == b);
  CHECK(mixed(a, b, 0.25) == Color{2.0, 1.5, 3.0});
}

TEST_CASE("pattern: numbers below 0 wrap too", "[scenes]") {
  CHECK(wrapped(0, 5) == 0);
  CHECK(wrapped(5, 5) == 0);
  CHECK(wrapped(13, 5) == 3);
  CHECK(wrapped(-1, 5) == 4);
  CHECK(wrapped(-5, 5) == 0);
}

TEST_CASE("pattern: noise is periodic, between 0 and 1, and the lattice's own number on the lattice",
          "[scenes]") {
  constexpr int kCells = 4;
  for (const double x : {0.0, 0.1, 0.375, 0.9}) {
    for (const double y : {0.05, 0.5, 0.75}) {
      const double value = noise(3, 5, x, y, kCells);
      CHECK((value >= 0.0 && value <= 1.0));
      CHECK(noise(3, 5, x + 1.0, y - 2.0, kCells) == Approx(value).margin(1e-12));
      CHECK(noise(4, 5, x, y, kCells) != value);
      CHECK(noise(3, 6, x, y, kCells) != value);
    }
  }
  for (int j = -1; j <= kCells; ++j)
    for (int i = -1; i <= kCells; ++i)
      CHECK(noise(3, 5, 0.25 * i, 0.25 * j, kCells) ==
            random(3, 5, std::uint64_t(wrapped(i, kCells)), std::uint64_t(wrapped(j, kCells))));
  // Without a step from one cell into the next, nor a bend.
  const double h = 1e-4, edge = 0.25, y = 0.3;
  const double before = noise(3, 5, edge - h, y, kCells), at = noise(3, 5, edge, y, kCells),
               behind = noise(3, 5, edge + h, y, kCells);
  CHECK(std::abs(at - before) < 1e-6);
  CHECK(std::abs(behind - at) < 1e-6);
}

TEST_CASE("pattern: fractal noise is the sum of its octaves about 0", "[scenes]") {
  for (const double x : {0.13, 0.6}) {
    const double sum = (noise(1, 7, x, 0.4, 3) - 0.5) + 0.6 * (noise(1, 8, x, 0.4, 6) - 0.5) +
                       0.36 * (noise(1, 9, x, 0.4, 12) - 0.5);
    CHECK(fractal(1, 7, x, 0.4, 3, 3, 0.6) == Approx(sum));
  }
  CHECK(fractal(1, 7, 0.13, 0.4, 3, 0, 0.6) == 0.0);
}

TEST_CASE("pattern: cells are periodic, and known by their distance from the border", "[scenes]") {
  constexpr int kCells = 5;
  int crossed = 0;
  Cell before = cellAt(2, 9, 0.0, 0.37, kCells);
  constexpr int kSteps = 2000;
  for (int n = 1; n <= kSteps; ++n) {
    const double x = double(n) / kSteps;
    const Cell cell = cellAt(2, 9, x, 0.37, kCells);
    CHECK((cell.shade >= 0.0 && cell.shade < 1.0));
    CHECK((cell.border >= 0.0 && cell.border < 1.5));
    // On the way to another cell lies the border, which comes no nearer than the way there.
    const double way = double(kCells) / kSteps + 1e-9;
    if (cell.shade != before.shade) {
      ++crossed;
      CHECK(before.border + cell.border <= way);
    } else {
      CHECK(std::abs(cell.border - before.border) <= way);
    }
    before = cell;
  }
  CHECK(crossed >= kCells - 2);
  const Cell here = cellAt(2, 9, 0.83, 0.37, kCells), there = cellAt(2, 9, -1.17, 3.37, kCells);
  CHECK(there.shade == here.shade);
  CHECK(there.border == Approx(here.border).margin(1e-9));
}

TEST_CASE("pattern: linear values become sRGB, cut to what can be shown", "[scenes]") {
  CHECK(encoded(-1.0) == 0.0);
  CHECK(encoded(0.0) == 0.0);
  CHECK(encoded(0.002) == Approx(0.02584));
  CHECK(encoded(0.0031308) == Approx(0.04045).epsilon(1e-4));
  CHECK(encoded(0.2140411) == Approx(0.5).epsilon(1e-5));
  CHECK(encoded(1.0) == Approx(1.0));
  CHECK(encoded(9.0) == encoded(1.0));
}

TEST_CASE("pattern: a map has the level in the middle of each pixel, row by row from the top", "[scenes]") {
  const auto across = levelMap(4, [](double x, double) { return x; });
  const auto down = levelMap(4, [](double, double y) { return y; });
  const std::uint8_t levels[] = {32, 96, 159, 223};  // 255 times 1/8, 3/8, 5/8, 7/8
  REQUIRE(across.size() == 16);
  REQUIRE(down.size() == 16);
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      CHECK(across[4 * row + column] == levels[column]);
      CHECK(down[4 * row + column] == levels[row]);
    }
  }
}

TEST_CASE("pattern: a picture's pixels are means of linear colours, row by row from the top", "[scenes]") {
  // Black and white in turn, finer than the pixels: half the light.
  const auto fine = rendered(2, 4, [](double x, double) {
    const double light = int(std::floor(8.0 * x)) % 2;
    return Color{light, light, light};
  });
  REQUIRE(fine.size() == 12);
  for (const int value : fine) CHECK(value == 188);
  // Red to the right, green downwards, blue nowhere; one sample each lies in the middle.
  std::set<std::pair<double, double>> asked;
  const auto plain = rendered(2, 1, [&](double x, double y) {
    asked.insert({x, y});
    return Color{x > 0.5 ? 1.0 : 0.0, y > 0.5 ? 1.0 : 0.0, 0.0};
  });
  CHECK(plain == std::vector<std::uint8_t>{0, 0, 0, 255, 0, 0, 0, 255, 0, 255, 255, 0});
  CHECK(asked == std::set<std::pair<double, double>>{{0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}});
}

}  // namespace fluidtex::exemplars
