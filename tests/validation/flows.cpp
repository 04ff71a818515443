#include "tests/validation/flows.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::FloatLeaf;
using sim::kLeafDim;
using sim::kLeafSize;
using std::numbers::pi;

double square(double x) {
  return x * x;
}

// A flow in the plane from its stream function: u = d psi / dy, v = -d psi / dx.
std::function<Vec3d(const Vec3d&)> plane(std::function<double(double, double)> stream) {
  return [stream](const Vec3d& x) { return Vec3d(0.0, 0.0, stream(x[0], x[1])); };
}

std::function<double(double)> reversing(double duration) {
  return [duration](double t) { return std::cos(pi * t / duration); };
}

}  // namespace

Flow rotation() {
  return {plane([](double x, double y) { return -pi * (square(x - 0.5) + square(y - 0.5)); }),
          [](double) { return 1.0; }, 1.0};
}

Flow singleVortex(double duration) {
  return {plane([](double x, double y) { return -square(std::sin(pi * x)) * square(std::sin(pi * y)) / pi; }),
          reversing(duration), duration};
}

Flow deformation2d() {
  return {plane([](double x, double y) {
            return -std::sin(4.0 * pi * (x + 0.5)) * std::cos(4.0 * pi * (y + 0.5)) / (4.0 * pi);
          }),
          reversing(2.0), 2.0};
}

Flow deformation3d() {
  const auto potential = [](const Vec3d& x) {
    const double sx = square(std::sin(pi * x[0])), sy = square(std::sin(pi * x[1])),
                 sz = square(std::sin(pi * x[2]));
    return Vec3d(0.0, -sx * std::sin(2.0 * pi * x[1]) * sz / pi, sx * sy * std::sin(2.0 * pi * x[2]) / pi);
  };
  return {potential, reversing(3.0), 3.0};
}

Flow diagonal() {
  return {plane([](double x, double y) { return y - x; }), [](double) { return 1.0; }, 1.0};
}

sim::Velocity faceVelocity(const Flow& flow, const Coord& cells, int margin, double h) {
  sim::FloatTree topology(0.0f);
  const int first = -margin & ~(kLeafDim - 1);
  for (int i = first; i < cells[0] + margin; i += kLeafDim)
    for (int j = first; j < cells[1] + margin; j += kLeafDim)
      for (int k = first; k < cells[2] + margin; k += kLeafDim)
        topology.touchLeaf(Coord(i, j, k))->setValuesOn();
  sim::Velocity velocity = sim::makeVelocity(h, topology);
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto leaves = sim::leavesOf(velocity.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (int i = 0; i < kLeafSize; ++i) {
        const Coord cell = leaves[n]->offsetToGlobalCoord(i);
        const Vec3d corner(cell[0] * h, cell[1] * h, cell[2] * h);
        // The potential along an edge, taken at its middle.
        const auto along = [&](int direction, int across, double shift) {
          Vec3d x = corner;
          x[direction] += 0.5 * h;
          x[across] += shift;
          return flow.potential(x)[direction];
        };
        const double around = along(b, c, 0.0) + along(c, b, h) - along(b, c, h) - along(c, b, 0.0);
        leaves[n]->setValueOnly(i, static_cast<float>(around / h));
      }
    });
  }
  return velocity;
}

void scale(const sim::Velocity& from, double factor, sim::Velocity& to) {
  const float by = static_cast<float>(factor);
  for (int axis = 0; axis < 3; ++axis) {
    const auto source = sim::leavesOf(std::as_const(*from.component[axis]).constTree());
    const auto target = sim::leavesOf(to.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, source.size(), [&](std::size_t n) {
      const float* in = source[n]->buffer().data();
      float* out = target[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) out[i] = by * in[i];
    });
  }
}

}  // namespace fluidtex::validation
