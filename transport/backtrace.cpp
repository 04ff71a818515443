// Third-order Runge-Kutta after Ralston: Runge-Kutta Methods with Minimum Error Bounds (1962).
#include "transport/backtrace.h"

#include "transport/velocity_sampler.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::transport {
namespace {

constexpr std::size_t kGrain = 256;
// An inner step moves at most this many cells, and deforms by at most this strain where the gradient is
// followed.
constexpr double kCellsPerStep = 1.0;
constexpr double kStrainPerStep = 0.5;
// Of one substep; a velocity that asks for more is not a velocity of the simulation.
constexpr int kMaxSteps = 64;

double largestEntry(const Mat3d& a) {
  double largest = 0.0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a.asPointer()[i]));
  return largest;
}

// A path in progress. With direction -1 time runs backwards.
struct Path {
  Vec3d x;
  Mat3d map;         // d x / d start
  double known = 0;  // s
};

// dX/ds = sign u(X), dB/ds = sign A(X) B, A = grad u. A is taken in the middle of each inner step, and held:
// B is multiplied by exp(h A) up to its third power, second order in all and third where A is the same
// everywhere.
template <bool kGradient>
void follow(VelocitySampler& sampler, double dt, double sign, Path& path) {
  double left = dt;
  for (int step = 0; step < kMaxSteps && left > 0.0; ++step) {
    const VelocitySample first = sampler.velocity(path.x);
    const double speed = first.velocity.length();
    if (!std::isfinite(speed)) return;
    const double wanted = left * speed / (kCellsPerStep * sampler.voxelSize());
    double steps = std::clamp(std::ceil(wanted - 1e-9), 1.0, double(kMaxSteps - step));
    double length = left / steps, h = sign * length;
    const auto middle = [&] {
      const Vec3d x = path.x + first.velocity * (0.5 * h);
      return kGradient ? sampler.velocityAndGradient(x) : sampler.velocity(x);
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
    const VelocitySample third = sampler.velocity(path.x + second.velocity * (0.75 * h));
    const Vec3d mean = (first.velocity * 2.0 + second.velocity * 3.0 + third.velocity * 4.0) / 9.0;
    if (!std::isfinite(mean.length())) return;
    path.x += mean * h;
    if constexpr (kGradient) {
      // exp(h A) B by Horner's rule.
      Mat3d turned = path.map + second.gradient * path.map * (h / 3.0);
      turned = path.map + second.gradient * turned * (h / 2.0);
      path.map = path.map + second.gradient * turned * h;
    }
    path.known += length * (2.0 * first.known + 3.0 * second.known + 4.0 * third.known) / 9.0;
    left = steps > 1.0 ? left - length : 0.0;
  }
}

// The order in which paths are followed: by leaf of the velocity grids, so that neighbours in the order share
// their leaves. The result of a path does not depend on it.
std::vector<std::uint32_t> leafOrder(const std::vector<Vec3f>& positions, double voxelSize) {
  struct Key {
    std::uint64_t leaf;
    std::uint32_t index;
  };
  std::vector<Key> keys(positions.size());
  const double scale = voxelSize > 0.0 ? 1.0 / (8.0 * voxelSize) : 1.0;
  const auto part = [&](float x) {
    return std::uint64_t(std::int64_t(std::floor(x * scale)) + (1 << 20)) & 0x1fffff;
  };
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3f& x = positions[v];
    keys[v] = {part(x.x()) << 42 | part(x.y()) << 21 | part(x.z()), std::uint32_t(v)};
  }
  const auto before = [](const Key& a, const Key& b) {
    return a.leaf != b.leaf ? a.leaf < b.leaf : a.index < b.index;
  };
  if (!std::is_sorted(keys.begin(), keys.end(), before)) std::sort(keys.begin(), keys.end(), before);
  std::vector<std::uint32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const Key& key) { return key.index; });
  return order;
}

template <bool kGradient>
std::vector<Path> followAll(const std::vector<Vec3f>& positions, const sim::Frame& frame, double sign) {
  std::vector<const sim::Substep*> substeps;
  for (const sim::Substep& substep : frame.substeps) substeps.push_back(&substep);
  if (sign < 0.0) std::reverse(substeps.begin(), substeps.end());

  std::vector<Path> paths(positions.size());
  const double voxelSize = substeps.empty() ? 0.0 : VelocitySampler(*substeps[0]).voxelSize();
  const std::vector<std::uint32_t> order = leafOrder(positions, voxelSize);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        paths[order[i]].x = Vec3d(positions[order[i]]);
                        paths[order[i]].map.setIdentity();
                      }
                      for (const sim::Substep* substep : substeps) {
                        VelocitySampler sampler(*substep);
                        for (std::size_t i = range.begin(); i != range.end(); ++i) {
                          if (sampler.voxelSize() > 0.0)
                            follow<kGradient>(sampler, substep->dt, sign, paths[order[i]]);
                        }
                      }
                    });
  return paths;
}

}  // namespace

Backtrace traceBack(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  const std::vector<Path> paths = followAll<true>(positions, frame, -1.0);
  const double time =
      std::accumulate(frame.substeps.begin(), frame.substeps.end(), 0.0,
                      [](double sum, const sim::Substep& substep) { return sum + substep.dt; });
  Backtrace result;
  result.origin.reserve(paths.size());
  result.map.reserve(paths.size());
  result.known.reserve(paths.size());
  for (const Path& path : paths) {
    result.origin.push_back(path.x);
    result.map.push_back(path.map);
    result.known.push_back(time > 0.0 ? float(path.known / time) : 1.0f);
  }
  return result;
}

std::vector<Vec3f> traceForward(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  const std::vector<Path> paths = followAll<false>(positions, frame, 1.0);
  std::vector<Vec3f> result;
  result.reserve(paths.size());
  for (const Path& path : paths) result.emplace_back(path.x);
  return result;
}

}  // namespace fluidtex::transport
