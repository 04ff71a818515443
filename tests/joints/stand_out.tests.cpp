#include "tools/joints/stand_out.h"

#include <catch2/catch.hpp>

#include <functional>

using namespace fluidtex::joints;
using fluidtex::texture::Vec3f;

namespace {

// n x n pixels, a metre apart, of one way.
Seen picture(int n, const std::function<Kind(int, int)>& kind,
             const std::function<float(int, int)>& lightness) {
  Seen seen{n, n, {}, {}, {{}}};
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      seen.kind.push_back(kind(x, y));
      seen.position.emplace_back(float(x), float(y), 0.0f);
      seen.lightness[0].push_back(lightness(x, y));
    }
  return seen;
}

}  // namespace

TEST_CASE("stand out: gradients of each kind are those of its own pixels") {
  const Seen seen = picture(
      20, [](int x, int) { return x < 10 ? Kind::joint : Kind::elsewhere; },
      [](int x, int y) { return x < 10 ? 0.04f * float(x) + 0.03f * float(y) : 0.01f * float(y); });
  CHECK(contrastOf(seen, 0, Kind::joint, 2.0).gradient == Approx(0.05));
  CHECK(contrastOf(seen, 0, Kind::elsewhere, 2.0).gradient == Approx(0.01));
  CHECK(contrastOf(seen, 0, Kind::joint, 2.0).pixels == 200);
  CHECK(contrastOf(seen, 0, Kind::joint, 2.0).gradients == 9 * 19);
  CHECK(contrastOf(seen, 0, Kind::mixed, 2.0).pixels == 0);
}

TEST_CASE("stand out: steps are the share of pixels beside one") {
  // A line of steps down the middle of 21 columns: one column in 20 is beside it.
  const Seen seen = picture(
      21, [](int, int) { return Kind::joint; }, [](int x, int) { return x > 10 ? 0.2f : 0.0f; });
  const Contrast found = contrastOf(seen, 0, Kind::joint, 2.0);
  CHECK(found.steps == Approx(0.05));
  CHECK(found.gradient == Approx(0.01));
  CHECK(found.deviation == Approx(0.2 * std::sqrt(10.0 / 21.0 * 11.0 / 21.0)));
}

TEST_CASE("stand out: across a contour nothing is compared") {
  Seen seen = picture(
      20, [](int, int) { return Kind::elsewhere; }, [](int x, int) { return x > 10 ? 1.0f : 0.0f; });
  for (std::size_t i = 0; i < seen.position.size(); ++i)
    if (i % 20 > 10) seen.position[i] += Vec3f(0.0f, 0.0f, 5.0f);
  CHECK(contrastOf(seen, 0, Kind::elsewhere, 2.0).gradient == 0.0);
}
