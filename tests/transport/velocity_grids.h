// Frames whose velocity is given by a formula, for tests.
#pragma once

#include "sim/frame/frame.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace fluidtex::testing {

using openvdb::Mat3d;
using openvdb::Vec3d;
using Flow = std::function<Vec3d(const Vec3d&)>;

inline Mat3d matrix(double a, double b, double c, double d, double e, double f, double g, double h,
                    double i) {
  return Mat3d(a, b, c, d, e, f, g, h, i);  // rows
}

// Cells of side h, centres at h * (i, j, k) for lower <= i, j, k <= upper; faces as sim::Substep describes.
struct Cells {
  double h = 0.1;
  int lower = -12, upper = 12;
};

inline sim::FloatGrid::Ptr componentGrid(const Cells& cells, int axis, const Flow& flow) {
  auto grid = sim::FloatGrid::create(0.0f);
  auto transform = openvdb::math::Transform::createLinearTransform(cells.h);
  Vec3d shift(0.0);
  shift[axis] = -0.5 * cells.h;
  transform->postTranslate(shift);
  grid->setTransform(transform);
  auto accessor = grid->getAccessor();
  for (int i = cells.lower; i <= cells.upper; ++i) {
    for (int j = cells.lower; j <= cells.upper; ++j) {
      for (int k = cells.lower; k <= cells.upper; ++k) {
        const openvdb::Coord ijk(i, j, k);
        accessor.setValue(ijk, float(flow(grid->indexToWorld(ijk))[axis]));
      }
    }
  }
  return grid;
}

inline sim::Substep substep(const Cells& cells, double dt, const Flow& flow) {
  return {dt, componentGrid(cells, 0, flow), componentGrid(cells, 1, flow), componentGrid(cells, 2, flow)};
}

// `substeps` equal ones of one steady flow.
inline sim::Frame steadyFrame(const Cells& cells, double time, int substeps, const Flow& flow) {
  sim::Frame frame;
  frame.index = 2;
  frame.time = time;
  frame.substeps.assign(substeps, substep(cells, time / substeps, flow));
  return frame;
}

inline Flow linearFlow(const Mat3d& a) {
  return [a](const Vec3d& x) { return a * x; };
}

// Scattered through [-reach, reach]^3, crossing cells and leaves everywhere.
inline std::vector<openvdb::Vec3f> scattered(int count, double reach) {
  std::vector<openvdb::Vec3f> points;
  for (int i = 0; i < count; ++i) {
    const auto part = [&](double irrational) {
      return float((std::fmod(i * irrational, 1.0) * 2.0 - 1.0) * reach);
    };
    points.emplace_back(part(0.7548776662), part(0.5698402910), part(0.8191725134));
  }
  return points;
}

// The matrix exponential, by its series on a halved argument.
inline Mat3d exponential(Mat3d a) {
  int halvings = 0;
  for (;; ++halvings) {
    double largest = 0.0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.asPointer()[i]));
    if (largest < 0.1) break;
    a = a * 0.5;
  }
  Mat3d sum = Mat3d::identity(), term = Mat3d::identity();
  for (int n = 1; n < 16; ++n) {
    term = term * a * (1.0 / n);
    sum = sum + term;
  }
  for (; halvings > 0; --halvings) sum = sum * sum;
  return sum;
}

inline double largestDifference(const Mat3d& a, const Mat3d& b) {
  double largest = 0.0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.asPointer()[i] - b.asPointer()[i]));
  return largest;
}

inline Mat3d rotationAbout(const Vec3d& axis,
                           double rate) {  // angular velocity as a matrix: A x = rate axis x x
  const Vec3d w = axis.unit() * rate;
  return matrix(0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0);
}

}  // namespace fluidtex::testing
