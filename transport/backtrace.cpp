// Third-order Runge-Kutta after Ralston: Runge-Kutta Methods with Minimum Error Bounds (1962).
#include "transport/backtrace.h"

#include "texture/loops/morton.h"
#include "texture/loops/parallel.h"
#include "transport/velocity_sampler.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace fluidtex::transport {
namespace {

// Bounds on an inner step: cells of motion, and strain where the gradient is followed.
constexpr double kCellsPerStep = 1.0;
constexpr double kStrainPerStep = 0.5;
// Per substep; a velocity that needs more is not one of the simulation.
constexpr int kMaxSteps = 64;
// Velocities are copied to a dense window if the paths' box has at most this many cells per path: reading a
// path's values one by one costs about as much as copying these.
constexpr double kCellsPerPath = 40.0;
constexpr double kMargin = 0.25;  // cells around the box
constexpr std::size_t kGroupsPerTask = 16;

double largestEntry(const Mat3d& a) {
  double largest = 0.0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.asPointer()[i]));
  return largest;
}

// A path in progress. direction -1: backwards in time.
struct Path {
  Vec3d x;
  Mat3d map;            // d x / d start
  double known = 0;     // s
  double left = 0;      // s, of the substep
  std::uint32_t index;  // of the position it started from
};

// One inner step, the `step`-th of its substep, of dX/ds = sign u(X), dB/ds = sign A(X) B, A = grad u. A is
// evaluated in the middle of the step and held constant: B is multiplied by exp(h A) up to third power.
// Second order, third where A is constant.
template <bool kGradient>
void advance(VelocitySampler& sampler, double sign, int step, Path& path) {
  const WallSide side = sampler.sideOf(path.x);
  const VelocitySample first = sampler.velocity(path.x, side);
  const double left = std::exchange(path.left, 0.0), speed = first.velocity.length();
  const double wanted = left * speed / (kCellsPerStep * sampler.voxelSize());
  double steps = std::clamp(std::ceil(wanted - 1e-9), 1.0, double(kMaxSteps - step));
  double length = left / steps, h = sign * length;
  const auto middle = [&] {
    const Vec3d x = path.x + first.velocity * (0.5 * h);
    return kGradient ? sampler.velocityAndGradient(x, side) : sampler.velocity(x, side);
  };
  VelocitySample second = middle();
  if constexpr (kGradient) {
    const double strain = length * largestEntry(second.gradient);
    if (strain > kStrainPerStep && step + 1 < kMaxSteps) {
      steps = std::min(std::ceil(steps * strain / kStrainPerStep), double(kMaxSteps - step));
      length = left / steps, h = sign * length;
      second = middle();
    }
  }
  const VelocitySample third = sampler.velocity(path.x + second.velocity * (0.75 * h), side);
  const Vec3d mean =
      first.velocity * (2.0 / 9.0) + second.velocity * (3.0 / 9.0) + third.velocity * (4.0 / 9.0);
  path.x += mean * h;
  if constexpr (kGradient) {
    // exp(h A) B by Horner's rule.
    Mat3d turned = path.map + second.gradient * path.map * (h / 3.0);
    turned = path.map + second.gradient * turned * (h / 2.0);
    path.map = path.map + second.gradient * turned * h;
  }
  path.known += length * ((2.0 / 9.0) * first.known + (3.0 / 9.0) * second.known + (4.0 / 9.0) * third.known);
  if (steps > 1.0) path.left = left - length;
}

// Focuses the sampler on the velocities around the paths, as far as an inner step moves them if they all move
// like the middle one.
void focusOn(const std::vector<Path>& paths, double sign, VelocitySampler& sampler) {
  Vec3d lower = paths[0].x, upper = paths[0].x;
  for (const Path& path : paths) {
    lower = openvdb::math::minComponent(lower, path.x);
    upper = openvdb::math::maxComponent(upper, path.x);
  }
  const Path& middle = paths[paths.size() / 2];
  const double cell = sampler.voxelSize();
  Vec3d step = sampler.velocity(middle.x).velocity * (sign * middle.left);
  step *= std::min(1.0, kCellsPerStep * cell / std::max(step.length(), 1e-300));
  const Vec3d margin(kMargin * cell);
  lower += openvdb::math::minComponent(step, Vec3d(0.0)) - margin;
  upper += openvdb::math::maxComponent(step, Vec3d(0.0)) + margin;
  const Vec3d size = (upper - lower) / cell;
  if (size.x() * size.y() * size.z() < kCellsPerPath * double(paths.size())) sampler.focus(lower, upper);
}

// Takes a group of adjacent paths through one substep.
template <bool kGradient>
void follow(VelocitySampler& sampler, double dt, double sign, std::vector<Path>& paths) {
  if (sampler.voxelSize() == 0.0) return;
  for (Path& path : paths) path.left = dt;
  bool moving = dt > 0.0;
  for (int step = 0; step < kMaxSteps && moving; ++step) {
    focusOn(paths, sign, sampler);
    moving = false;
    for (Path& path : paths) {
      if (path.left > 0.0) advance<kGradient>(sampler, sign, step, path);
      moving |= path.left > 0.0;
    }
  }
}

// Positions by leaf of the velocity grids, ascending within each: the leaf, and the position's index.
struct Key {
  std::uint64_t leaf;
  std::uint32_t index;
};

std::vector<Key> keysByLeaf(const std::vector<Vec3f>& positions, double voxelSize) {
  std::vector<Key> keys(positions.size());
  const double scale = voxelSize > 0.0 ? 1.0 / (8.0 * voxelSize) : 1.0;
  const auto part = [&](float x) {
    return std::int64_t(std::max(-1e15, std::min(1e15, std::floor(x * scale))));
  };
  texture::forEachIndex(keys.size(), [&](std::uint32_t v) {
    const Vec3f& x = positions[v];
    keys[v] = {texture::mortonCode(part(x.x()), part(x.y()), part(x.z())), v};
  });
  tbb::parallel_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.leaf != b.leaf ? a.leaf < b.leaf : a.index < b.index;
  });
  return keys;
}

// Calls finish(path) for each position after all substeps. Positions of a leaf are traced together and share
// a window of velocities.
template <bool kGradient, typename Finish>
void followAll(const std::vector<Vec3f>& positions, const sim::Frame& frame, double sign,
               const Finish& finish) {
  std::vector<const sim::Substep*> substeps;
  for (const sim::Substep& substep : frame.substeps) substeps.push_back(&substep);
  if (sign < 0.0) std::reverse(substeps.begin(), substeps.end());

  const double voxelSize = substeps.empty() ? 0.0 : VelocitySampler(*substeps[0]).voxelSize();
  const std::vector<Key> keys = keysByLeaf(positions, voxelSize);
  std::vector<std::size_t> groups;  // where each begins
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].leaf != keys[i - 1].leaf) groups.push_back(i);
  }
  groups.push_back(keys.size());

  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, groups.size() - 1, kGroupsPerTask), [&](const auto& range) {
        std::vector<std::vector<Path>> paths(range.size());
        for (std::size_t g = 0; g < paths.size(); ++g) {
          for (std::size_t i = groups[range.begin() + g]; i < groups[range.begin() + g + 1]; ++i) {
            const std::uint32_t index = keys[i].index;
            paths[g].push_back({.x = Vec3d(positions[index]), .map = Mat3d::identity(), .index = index});
          }
        }
        for (const sim::Substep* substep : substeps) {
          VelocitySampler sampler(*substep);
          for (std::vector<Path>& group : paths) follow<kGradient>(sampler, substep->dt, sign, group);
        }
        for (const std::vector<Path>& group : paths) {
          for (const Path& path : group) finish(path);
        }
      });
}

}  // namespace

Backtrace traceBack(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  const double time =
      std::accumulate(frame.substeps.begin(), frame.substeps.end(), 0.0,
                      [](double sum, const sim::Substep& substep) { return sum + substep.dt; });
  Backtrace result;
  result.origin.resize(positions.size());
  result.map.resize(positions.size());
  result.known.resize(positions.size());
  followAll<true>(positions, frame, -1.0, [&](const Path& path) {
    result.origin[path.index] = path.x;
    result.map[path.index] = path.map;
    result.known[path.index] = time > 0.0 ? float(path.known / time) : 1.0f;
  });
  return result;
}

std::vector<Vec3f> traceForward(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  std::vector<Vec3f> result(positions.size());
  followAll<false>(positions, frame, 1.0, [&](const Path& path) { result[path.index] = Vec3f(path.x); });
  return result;
}

}  // namespace fluidtex::transport
