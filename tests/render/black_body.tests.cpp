#include "render/black_body.h"

#include <catch2/catch.hpp>

using namespace fluidtex::render;

namespace {

struct Chromaticity {
  double x, y;
};

Chromaticity chromaticityOf(const Vec3f& rgb) {
  const double x = 0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2];
  const double y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  const double z = 0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2];
  return {x / (x + y + z), y / (x + y + z)};
}

}  // namespace

TEST_CASE("black body: colours lie on the Planckian locus", "[render]") {
  // CIE 1931 2 degree, from tables of the locus; at 2000 K and above it lies within Rec. 709 or nearly so.
  struct Row {
    double kelvin, x, y;
  };
  for (const Row& row : {Row{2500, 0.4770, 0.4137}, Row{3000, 0.4369, 0.4041}, Row{4000, 0.3805, 0.3768},
                         Row{5000, 0.3451, 0.3516}, Row{6500, 0.3135, 0.3237}, Row{10000, 0.2807, 0.2884}}) {
    const Chromaticity found = chromaticityOf(blackBody(row.kelvin));
    CAPTURE(row.kelvin);
    CHECK(found.x == Approx(row.x).margin(0.004));
    CHECK(found.y == Approx(row.y).margin(0.004));
  }
}

TEST_CASE("black body: lava is red where it is cool, and far brighter where it is hot", "[render]") {
  const Vec3f cool = blackBody(900.0), hot = blackBody(1450.0);
  CHECK(cool[1] < 0.1f * cool[0]);
  CHECK(hot[1] > 0.1f * hot[0]);
  CHECK(hot[2] == 0.0f);
  // Near the peak of the eye's response Wien's law gives exp(c2 / lambda (1/900 - 1/1450)) at 600 nm: 24,000.
  const float ratio = luminance(hot) / luminance(cool);
  CHECK(ratio > 8000.0f);
  CHECK(ratio < 30000.0f);
}
