#include "texture/loops/complex.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

TEST_CASE("complex: products as std::complex has them") {
  const std::complex<double> a(1.5, -2.0), b(-0.25, 3.0);
  CHECK(std::abs(product(a, b) - a * b) < 1e-15);
  CHECK(std::abs(conjugateProduct(a, b) - std::conj(a) * b) < 1e-15);
  const std::complex<float> i(0.0f, 1.0f);
  CHECK(product(i, i) == std::complex<float>(-1.0f, 0.0f));
  CHECK(conjugateProduct(i, i) == std::complex<float>(1.0f, 0.0f));
}
