#include "sim/scalars/advect_scalar.h"

#include "tests/sim/heat/pool.h"
#include "tests/sim/velocity/velocity_field.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace fluidtex::sim;

TEST_CASE("advect scalar: an even temperature stays, another one moves with the flow", "[sim]") {
  const double dt = 0.05;
  const auto flow = [](const Vec3d& x) { return Vec3d(0.5 - x[1], x[0] - 0.5, 0.0); };
  Pool even(16, 0.5, [](const Vec3d&) { return 1234.5; });
  const Velocity turn = velocityField(even.h, even.phi->tree(), flow);
  const auto kept = advectScalar(*even.temperature, turn, even.phi->tree(), *even.phi, even.solid, dt);
  for (auto it = kept->cbeginValueOn(); it; ++it) {
    const Coord c = it.getCoord();  // in the domain: what comes from beyond the leaves is not known
    if (std::min({c[0], c[1], c[2]}) >= 0 && std::max({c[0], c[1], c[2]}) < 16) REQUIRE(*it == 1234.5f);
  }

  std::vector<double> errors;
  for (const int n : {16, 32, 64}) {
    const auto spot = [](const Vec3d& x) {
      return 1000.0 + 100.0 * std::exp(-40.0 * (Vec3d(0.65, 0.5, 0.3) - x).lengthSqr());
    };
    Pool pool(n, 0.9, spot);
    const Velocity speed = velocityField(pool.h, pool.phi->tree(), flow);
    FloatGrid::Ptr t = pool.temperature;
    const int steps = n / 2;
    const double whole = 1.0;
    for (int s = 0; s < steps; ++s)
      t = advectScalar(*t, speed, pool.phi->tree(), *pool.phi, pool.solid, whole / steps);
    double largest = 0.0;
    for (auto it = t->cbeginValueOn(); it; ++it) {
      const Vec3d x = t->indexToWorld(it.getCoord());
      const Vec3d r = x - Vec3d(0.5, 0.5, 0.0);
      if (std::hypot(r[0], r[1]) > 0.35 || x[2] < 0.1 || x[2] > 0.7) continue;
      const Vec3d back(0.5 + r[0] * std::cos(whole) + r[1] * std::sin(whole),
                       0.5 - r[0] * std::sin(whole) + r[1] * std::cos(whole), x[2]);
      largest = std::max(largest, std::abs(*it - spot(back)));
    }
    errors.push_back(largest);
  }
  INFO(errors[0] << " " << errors[1] << " " << errors[2]);
  CHECK(errors[1] < 0.45 * errors[0]);
  CHECK(errors[2] < 0.45 * errors[1]);
}
