// Zalesak's slotted sphere in rigid rotation (Enright et al. 2002): radius 15 of a domain of 100 cells, the
// slot 5 wide and 12.5 deep; by the trace and by the paper's fields on the grid.
#include "tests/transport/velocity_grids.h"
#include "transport/backtrace.h"
#include "transport/grid_transport.h"

#include <catch2/catch.hpp>

#include <numbers>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

namespace {

const Vec3d kAxis(50, 50, 50), kCenter(50, 75, 50);
// A power of two, so that velocities in single precision are exact; coordinates are halves.
constexpr double kRate = 1.0 / 64.0;

// Points on the sphere outside the slot, and on the slot's walls and bottom.
std::vector<Vec3f> surfacePoints(int count) {
  std::vector<Vec3f> points;
  const auto part = [](int i, double irrational) { return std::fmod(i * irrational, 1.0); };
  for (int i = 1; i <= count; ++i) {
    const double a = part(i, 0.7548776662), b = part(i, 0.5698402910);
    const double z = 2 * a - 1, angle = 2 * std::numbers::pi * b, r = std::sqrt(1 - z * z);
    const Vec3d p = Vec3d(r * std::cos(angle), r * std::sin(angle), z) * 15.0;
    const bool inSlot = std::abs(p.x()) < 2.5 && p.y() < -2.5;
    if (!inSlot) points.emplace_back(kCenter + p);
    const Vec3d wall(i % 2 ? 2.5 : -2.5, -2.5 - 12.5 * a, 30 * b - 15);
    if (wall.length() < 15.0) points.emplace_back(kCenter + wall);
    const Vec3d bottom(5 * a - 2.5, -2.5, 30 * b - 15);
    if (bottom.length() < 15.0) points.emplace_back(kCenter + bottom);
  }
  return points;
}

sim::Frame fullTurn(int substeps) {
  static const sim::Substep velocity = substep({1.0, 0, 100}, 1.0, [](const Vec3d& x) {
    return Vec3d(kAxis.y() - x.y(), x.x() - kAxis.x(), 0.0) * kRate;
  });
  sim::Frame frame;
  frame.index = 2;
  frame.substeps.assign(std::size_t(substeps), velocity);
  for (sim::Substep& step : frame.substeps) step.dt = 2 * std::numbers::pi / kRate / substeps;
  return frame;
}

double farthest(const std::vector<Vec3f>& points, const std::vector<Vec3d>& origins) {
  double worst = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    worst = std::max(worst, (origins[i] - Vec3d(points[i])).length());
  return worst;
}

}  // namespace

TEST_CASE("slotted sphere: the trace brings every vertex home, with third order in the step", "[transport]") {
  const std::vector<Vec3f> points = surfacePoints(400);
  std::vector<double> errors;
  // At 314 steps a turn the farthest point moves 0.8 cells in one.
  for (const int substeps : {314, 628, 1256})
    errors.push_back(farthest(points, traceBack(points, fullTurn(substeps)).origin));
  CAPTURE(errors[0], errors[1], errors[2]);
  CHECK(errors[0] < 0.02);
  CHECK(std::log2(errors[0] / errors[1]) > 2.9);
  CHECK(std::log2(errors[1] / errors[2]) > 2.9);
}

TEST_CASE("coordinate fields: first order in cell and step", "[transport]") {
  // A twentieth of a turn of a rotor whose rate falls outwards: origins have a closed form.
  const auto rate = [](double r2) { return 2.0 * std::exp(-2.0 * r2); };
  const Flow flow = [&](const Vec3d& x) {
    const double w = rate(x.x() * x.x() + x.y() * x.y());
    return Vec3d(-w * x.y(), w * x.x(), 0.0);
  };
  std::vector<Vec3f> points;
  for (int i = 0; i < 60; ++i) {
    const double r = 0.1 + 0.01 * i, a = 2.4 * i;
    points.emplace_back(float(r * std::cos(a)), float(r * std::sin(a)), 0.0f);
  }
  const double time = 0.4;
  std::vector<double> grid, trace;
  for (const int cells : {16, 32, 64}) {
    const double h = 1.0 / cells;
    // Thin along z, where nothing happens.
    sim::Frame frame = steadyFrame({h, -cells - 2, cells + 2}, time, cells / 4, flow);
    for (sim::Substep& step : frame.substeps) {
      for (auto* component : {&step.u, &step.v, &step.w}) {
        auto thin = (*component)->deepCopy();
        thin->clip(openvdb::CoordBBox(openvdb::Coord(-1000, -1000, -2), openvdb::Coord(1000, 1000, 2)));
        *component = thin;
      }
    }
    const auto meanError = [&](const Backtrace& back) {
      double sum = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d x(points[i]);
        const double turn = -rate(x.x() * x.x() + x.y() * x.y()) * time;
        const Vec3d exact(std::cos(turn) * x.x() - std::sin(turn) * x.y(),
                          std::sin(turn) * x.x() + std::cos(turn) * x.y(), x.z());
        sum += (back.origin[i] - exact).length() / double(points.size());
      }
      return sum;
    };
    grid.push_back(meanError(traceOnGrid(points, frame)));
    trace.push_back(meanError(traceBack(points, frame)));
  }
  CAPTURE(grid[0], grid[1], grid[2], trace[0], trace[1], trace[2]);
  for (std::size_t i = 1; i < 3; ++i) {
    CHECK(std::log2(grid[i - 1] / grid[i]) > 0.8);
    CHECK(std::log2(grid[i - 1] / grid[i]) < 1.5);
    CHECK(std::log2(trace[i - 1] / trace[i]) > 1.8);  // the velocity's own interpolation is second order
  }
  for (std::size_t i = 0; i < 3; ++i) CHECK(trace[i] < 0.3 * grid[i]);
}
