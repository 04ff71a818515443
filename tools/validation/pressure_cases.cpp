#include "tools/validation/pressure_cases.h"

#include "sim/grid/mac_grid.h"
#include "sim/pressure/pressure.h"
#include "tools/validation/order.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;

constexpr double kDensity = 1000.0, kDt = 0.01, kToPressure = kDensity / kDt;

// A shell of liquid around a solid ball, in m. The pressure p = f(r) (1 + n . m / 2) density / dt, with n the
// direction from the middle, has no slope normal to the ball and is 0 at the surface; on the ball it is
// neither flat nor 0. What is projected is a turning about the ball, free of divergence and tangential to it,
// plus the gradient of p: the turning is what must be left.
struct Shell {
  static constexpr double kBall = 0.2, kSurface = 0.43;
  Vec3d middle{0.503, 0.497, 0.491}, tilt{0.48, -0.6, 0.64}, spin{0.3, 0.5, -0.4};

  double distance(const Vec3d& x) const { return (x - middle).length() - kSurface; }
  double pressure(const Vec3d& x) const {
    const Vec3d d = x - middle;
    const double r = d.length();
    return profile(r) * (1.0 + 0.5 * tilt.dot(d / r));
  }
  Vec3d gradient(const Vec3d& x) const {
    const Vec3d d = x - middle;
    const double r = d.length();
    const Vec3d n = d / r;
    const double along = tilt.dot(n);
    return slope(r) * (1.0 + 0.5 * along) * n + profile(r) * 0.5 / r * (tilt - along * n);
  }
  Vec3d velocity(const Vec3d& x) const { return spin.cross(x - middle); }

 private:
  static constexpr double kSpan = kSurface * kSurface - kBall * kBall;
  static double share(double r) { return (r * r - kBall * kBall) / kSpan; }
  static double profile(double r) { return 1.0 - share(r) * share(r); }
  static double slope(double r) { return -4.0 * share(r) * r / kSpan; }
};

Result manufactured(int resolution, const Progress&) {
  const Shell shell;
  sim::Options options;
  options.resolution = resolution;
  options.solids.resize(1);
  options.solids[0].shape.kind = sim::Sphere{shell.middle, Shell::kBall};
  const double h = options.voxelSize();
  const auto solid = sim::Solids(options).at(0.0);
  sim::FloatGrid::Ptr phi = sim::makePhi(h, 3.0 * h);
  for (int i = 0; i < resolution; i += sim::kLeafDim) {
    for (int j = 0; j < resolution; j += sim::kLeafDim) {
      for (int k = 0; k < resolution; k += sim::kLeafDim)
        phi->tree().touchLeaf(Coord(i, j, k))->setValuesOn();
    }
  }
  for (auto it = phi->beginValueOn(); it; ++it)
    it.setValue(static_cast<float>(shell.distance(phi->indexToWorld(it.getCoord()))));
  sim::Velocity velocity = sim::makeVelocity(h, phi->tree());
  for (int a = 0; a < 3; ++a) {
    for (auto it = velocity.component[a]->beginValueOn(); it; ++it) {
      const Vec3d x = velocity.component[a]->indexToWorld(it.getCoord());
      if (x != shell.middle) it.setValue(static_cast<float>(shell.velocity(x)[a] + shell.gradient(x)[a]));
    }
  }
  sim::PressureOptions settings;
  settings.tolerance = 1e-11;
  settings.maxSeparationPasses = 0;
  settings.keepPressure = true;
  auto& [u, v, w] = velocity.component;
  const sim::Projection projection = sim::project(velocity, *phi, *solid, kDt, kDensity, settings);
  const std::string test = "pressure";
  const auto row = [&](const char* measure, double value) {
    return Row{test, resolution, measure, value, {}, {}, false, {}, 0.0};
  };
  Result result;
  if (!projection.report.converged) {
    result.rows = {row("solves that did not converge", 1.0)};
    result.rows[0].must = 0.0;
    return result;
  }
  double pressureMost = 0.0, velocityMost = 0.0, velocitySum = 0.0;
  int count = 0;
  for (auto it = projection.pressure->cbeginValueOn(); it; ++it) {
    const Vec3d x = projection.pressure->indexToWorld(it.getCoord());
    // Cells whose middle lies in the ball have a pressure that nothing is compared with.
    if ((x - shell.middle).length() < Shell::kBall) continue;
    pressureMost = std::max(pressureMost, std::abs(*it / kToPressure - shell.pressure(x)));
  }
  const auto& valid = projection.valid.component;
  for (int a = 0; a < 3; ++a) {
    for (auto it = valid[a]->cbeginValueOn(); it; ++it) {
      const Vec3d x = velocity.component[a]->indexToWorld(it.getCoord());
      if ((x - shell.middle).length() < Shell::kBall) continue;
      const double error =
          std::abs(velocity.component[a]->tree().getValue(it.getCoord()) - shell.velocity(x)[a]);
      velocityMost = std::max(velocityMost, error);
      velocitySum += error;
      ++count;
    }
  }
  result.rows = {row("largest error of p, m2/s", pressureMost), row("largest error of u, m/s", velocityMost),
                 row("mean error of u, m/s", velocitySum / count)};
  return result;
}

}  // namespace

std::vector<Case> pressureCases() {
  return {{"pressure",
           "fluid",
           "Pressure between a solid ball and a round surface, manufactured",
           {16, 32, 64, 128, 256},
           {16, 32, 64},
           manufactured,
           [](const std::vector<Row>& rows) {
             std::vector<Row> orders = orderRows(rows, "largest error of p, m2/s", 1.9, {});
             for (const Row& row : orderRows(rows, "largest error of u, m/s", 0.9, {})) orders.push_back(row);
             for (const Row& row : orderRows(rows, "mean error of u, m/s", 1.8, {})) orders.push_back(row);
             return orders;
           }}};
}

}  // namespace fluidtex::validation
