#include "scenes/exemplars/waves.h"

#include "tests/scenes/exemplars/pixels.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace fluidtex::exemplars {

TEST_CASE("waves: the pictures that ship are the generator's", "[scenes]") {
  const Waves options;
  const WaveImages images = makeWaves(options);
  CHECK((shipped("waves.png", options.size) == images.pixels));
  CHECK((shipped("waves_normals.png", options.size) == images.normals));
}

TEST_CASE("waves: toroidal in both directions, with unit normals of the slope asked for", "[scenes]") {
  const Waves options{.size = 256, .steep = 0.15};
  const WaveImages images = makeWaves(options);
  CHECK(isToroidal(images.pixels, options.size));
  CHECK(isToroidal(images.normals, options.size));
  double square = 0.0, across = 0.0;
  for (std::size_t i = 0; i < images.normals.size(); i += 3) {
    double n[3], length = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      n[k] = images.normals[i + k] / 127.5 - 1.0;
      length += n[k] * n[k];
    }
    CHECK(std::sqrt(length) == Approx(1.0).margin(0.01));
    square += (n[0] * n[0] + n[1] * n[1]) / (n[2] * n[2]);
    across += n[0] * n[0] / (n[2] * n[2]);
  }
  CHECK(std::sqrt(3.0 * square / double(images.normals.size())) == Approx(options.steep).epsilon(0.12));
  CHECK(across < 0.3 * square);  // crests along the rows
}

}  // namespace fluidtex::exemplars
