#include "sim/motion/known_flow.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace fluidtex::sim {
namespace {

using std::numbers::pi;

double square(double x) {
  return x * x;
}

// A flow in the plane from its stream function: u = d psi / dy, v = -d psi / dx.
std::function<Vec3d(const Vec3d&)> plane(std::function<double(double, double)> stream) {
  return [stream = std::move(stream)](const Vec3d& x) { return Vec3d(0.0, 0.0, stream(x[0], x[1])); };
}

std::function<double(double)> reversing(double duration) {
  return [duration](double t) { return std::cos(pi * t / duration); };
}

double steady(double) {
  return 1.0;
}

}  // namespace

KnownFlow singleVortex(double duration) {
  return {plane([](double x, double y) { return -square(std::sin(pi * x)) * square(std::sin(pi * y)) / pi; }),
          reversing(duration), duration};
}

KnownFlow deformation2d() {
  return {plane([](double x, double y) {
            return -std::sin(4.0 * pi * (x + 0.5)) * std::cos(4.0 * pi * (y + 0.5)) / (4.0 * pi);
          }),
          reversing(2.0), 2.0};
}

KnownFlow deformation3d(double duration) {
  const auto potential = [](const Vec3d& x) {
    const double sx = square(std::sin(pi * x[0])), sy = square(std::sin(pi * x[1])),
                 sz = square(std::sin(pi * x[2]));
    return Vec3d(0.0, -sx * std::sin(2.0 * pi * x[1]) * sz / pi, sx * sy * std::sin(2.0 * pi * x[2]) / pi);
  };
  return {potential, [=](double t) { return 3.0 / duration * std::cos(pi * t / duration); }, duration};
}

KnownFlow diagonal() {
  return {plane([](double x, double y) { return y - x; }), steady, 1.0};
}

KnownFlow still() {
  return {{}, steady, 0.0, [](const Vec3d&) { return Vec3d(0.0); }};
}

KnownFlow rotation(const Vec3d& middle, double rate) {
  return {plane([=](double x, double y) {
            return -0.5 * rate * (square(x - middle[0]) + square(y - middle[1]));
          }),
          steady, 2.0 * pi / std::abs(rate)};
}

KnownFlow stretch(const Vec3d& middle, double rate) {
  return {{}, steady, 0.0, [=](const Vec3d& x) { return Vec3d(rate * (x[0] - middle[0]), 0.0, 0.0); }};
}

KnownFlow sourceAndSink(const Vec3d& size, double rate) {
  const auto along = [=](double x, double length) {
    return 0.5 * rate * length / (3.0 * pi) * std::sin(3.0 * pi * x / length);
  };
  return {{}, steady, 0.0, [=](const Vec3d& x) {
            return Vec3d(along(x[0], size[0]), along(x[1], size[1]), 0.0);
          }};
}

KnownFlow slot(double speed, double strain) {
  return {
      {}, steady, 0.0, [=](const Vec3d& x) { return Vec3d(speed + strain * std::max(x[0], 0.0), 0.0, 0.0); }};
}

double timeFromSlot(double x, double speed, double strain) {
  if (x <= 0.0) return 0.0;
  return strain > 0.0 ? std::log1p(strain * x / speed) / strain : x / speed;
}

KnownFlow drawnOut(const KnownFlow& unit, const Vec3d& size, double factor) {
  // u_i = L_i U_i(x / L) is the curl of A_i = L_j L_k A_i(x / L).
  const Vec3d areas(size[1] * size[2], size[2] * size[0], size[0] * size[1]);
  return {[=](const Vec3d& x) { return factor * areas * unit.potential(x / size); }, unit.strength,
          unit.duration};
}

Velocity faceVelocity(const KnownFlow& flow, const Coord& cells, int margin, double h) {
  FloatTree topology(0.0f);
  const int first = -margin & ~(kLeafDim - 1);
  for (int i = first; i < cells[0] + margin; i += kLeafDim)
    for (int j = first; j < cells[1] + margin; j += kLeafDim)
      for (int k = first; k < cells[2] + margin; k += kLeafDim)
        topology.touchLeaf(Coord(i, j, k))->setValuesOn();
  Velocity velocity = makeVelocity(h, topology);
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto leaves = leavesOf(velocity.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (int i = 0; i < kLeafSize; ++i) {
        const Coord cell = leaves[n]->offsetToGlobalCoord(i);
        if (!flow.potential) {
          const Vec3d x = velocity.component[axis]->indexToWorld(cell);
          leaves[n]->setValueOnly(i, static_cast<float>(flow.velocity(x)[axis]));
          continue;
        }
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

void scale(const Velocity& from, double factor, Velocity& to) {
  const float by = static_cast<float>(factor);
  for (int axis = 0; axis < 3; ++axis) {
    const FloatTree& source = from.component[axis]->constTree();
    const auto target = leavesOf(to.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, target.size(), [&](std::size_t n) {
      const float* in = source.probeConstLeaf(target[n]->origin())->buffer().data();
      float* out = target[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) out[i] = by * in[i];
    });
  }
}

}  // namespace fluidtex::sim
