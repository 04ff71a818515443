#include "scenes/exemplars/ripples.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>

namespace fluidtex::exemplars {
namespace {

double difference(const Pixels& a, const Pixels& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(int(a[i]) - int(b[i]));
  return sum / double(a.size());
}

}  // namespace

TEST_CASE("ripples: the pictures that ship are the generator's", "[scenes]") {
  const Ripples options;
  for (const int n : {0, options.pictures - 1}) {
    char name[32];
    std::snprintf(name, sizeof name, "ripples/%04d.png", n);
    CHECK((shipped(name, options.size) == makeRipples(options, n)));
  }
}

TEST_CASE("ripples: toroidal in both directions, and in time", "[scenes]") {
  const Ripples options{.size = 64, .samples = 1};
  std::vector<Pixels> pictures;
  for (int n = 0; n < options.pictures; ++n) pictures.push_back(makeRipples(options, n));
  CHECK((makeRipples(options, options.pictures) == pictures.front()));
  for (const bool columns : {true, false}) {
    double largest = 0.0;
    for (int i = 0; i + 1 < options.size; ++i)
      largest = std::max(largest, step(pictures[0], options.size, i, i + 1, columns));
    CHECK(step(pictures[0], options.size, options.size - 1, 0, columns) <= largest);
  }
  // From picture to picture less changes than from half a loop to the other.
  const double far = difference(pictures[0], pictures[std::size_t(options.pictures) / 2]);
  for (std::size_t n = 0; n < pictures.size(); ++n)
    CHECK(difference(pictures[n], pictures[(n + 1) % pictures.size()]) < 0.6 * far);
}

}  // namespace fluidtex::exemplars
