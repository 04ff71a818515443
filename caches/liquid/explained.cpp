#include "caches/liquid/explained.h"

#include "caches/liquid/face_sampler.h"
#include "caches/liquid/level_set.h"

#include <openvdb/tools/Interpolation.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fluidtex::caches {
namespace {

constexpr std::size_t kPoints = 2000;
constexpr std::size_t kFewestPoints = 30;
constexpr double kMoved = 0.25;  // cells
// What a weight other than 1/2 has to explain more: below that it is no more than chance.
constexpr double kBetter = 0.005;
constexpr int kMostSteps = 64;
constexpr double kMostCells = 1e4;  // that a point moves in a frame: nothing lies farther
constexpr double kPathStep = 0.5;   // cells
constexpr double kShort = 1e-3;     // of a frame: in that, paths are straight

using Accessor = openvdb::FloatGrid::ConstAccessor;

double sample(const openvdb::FloatGrid& phi, const Accessor& accessor, const Vec3d& x) {
  return double(openvdb::tools::BoxSampler::sample(accessor, phi.worldToIndex(x)));
}

Vec3d gradient(const openvdb::FloatGrid& phi, const Accessor& accessor, const Vec3d& x, double h) {
  Vec3d result;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d step(0.0);
    step[axis] = 0.5 * h;
    result[axis] = (sample(phi, accessor, x + step) - sample(phi, accessor, x - step)) / h;
  }
  return result;
}

class Flow {
 public:
  // Velocities above `fastest` (m/s) are cut to that.
  Flow(const sim::FaceGrids& begin, const sim::FaceGrids& end, double meanWeight, double fastest)
      : m_begin(begin), m_end(end), m_meanWeight(meanWeight), m_fastest(fastest) {}

  Vec3d at(const Vec3d& x, double t) const {
    const Vec3d v = velocityAt(x, t);
    const double speed = v.length();
    return speed > m_fastest ? v * (m_fastest / speed) : v;
  }

 private:
  Vec3d velocityAt(const Vec3d& x, double t) const {
    const double w = weightAt(m_meanWeight, t);
    Vec3d a(0.0), b(0.0);
    const bool inBegin = w < 1.0 && m_begin.at(x, a), inEnd = w > 0.0 && m_end.at(x, b);
    if (inBegin && inEnd) return a + w * (b - a);
    return inBegin ? a : b;
  }

  FaceSampler m_begin, m_end;
  double m_meanWeight, m_fastest;
};

// Distances to phi = 0 of the points moved by `factor` times their displacements, clamped to the band, m.
std::vector<double> distances(const std::vector<Vec3d>& points, const std::vector<Vec3d>& displacement,
                              double factor, const openvdb::FloatGrid& phi) {
  const Accessor accessor = phi.getConstAccessor();
  const double most = kBand * phi.voxelSize()[0];
  std::vector<double> result(points.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    result[n] = std::min(std::abs(sample(phi, accessor, points[n] + factor * displacement[n])), most);
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / double(values.size());
}

// Those of the points that are not on the surface any more.
void keepMoved(const openvdb::FloatGrid& phi, std::vector<Vec3d>& points) {
  const Accessor accessor = phi.getConstAccessor();
  const double least = kMoved * phi.voxelSize()[0];
  std::erase_if(points, [&](const Vec3d& x) { return std::abs(sample(phi, accessor, x)) < least; });
}

}  // namespace

std::vector<Vec3d> surfacePoints(const openvdb::FloatGrid& phi, std::size_t most) {
  const double h = phi.voxelSize()[0];
  std::vector<Vec3d> near;
  for (auto leaf = phi.tree().cbeginLeaf(); leaf; ++leaf)
    for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel)
      if (std::abs(*voxel) < 0.5 * h) near.push_back(phi.indexToWorld(voxel.getCoord()));
  const Accessor accessor = phi.getConstAccessor();
  std::vector<Vec3d> points;
  const double stride = std::max(1.0, double(near.size()) / double(most));
  for (double n = 0.0; std::size_t(n) < near.size(); n += stride) {
    Vec3d x = near[std::size_t(n)];
    for (int step = 0; step < 2; ++step) {
      const Vec3d slope = gradient(phi, accessor, x, h);
      x -= slope * (sample(phi, accessor, x) / std::max(slope.lengthSqr(), 0.25));
    }
    if (std::abs(sample(phi, accessor, x)) < 0.05 * h) points.push_back(x);
  }
  return points;
}

double weightAt(double meanWeight, double t) {
  return meanWeight <= 0.5 ? 2.0 * meanWeight * t : 1.0 - 2.0 * (1.0 - meanWeight) * (1.0 - t);
}

std::vector<Vec3d> displacements(const std::vector<Vec3d>& points, const sim::FaceGrids& begin,
                                 const sim::FaceGrids& end, double meanWeight, double seconds) {
  std::vector<Vec3d> result(points.size());
  const Vec3d voxel = begin[0].voxelSize();
  const double h = std::min({voxel[0], voxel[1], voxel[2]});
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const Flow flow(begin, end, meanWeight, kMostCells * h / seconds);
                      for (std::size_t n = range.begin(); n != range.end(); ++n) {
                        const double cells = flow.at(points[n], 0.5).length() * seconds / h;
                        const int steps =
                            int(std::clamp(std::ceil(cells / kPathStep), 1.0, double(kMostSteps)));
                        Vec3d x = points[n];
                        for (int step = 0; step < steps; ++step) {
                          const double t = double(step) / steps, dt = seconds / steps;
                          const Vec3d middle = x + 0.5 * dt * flow.at(x, t);
                          x += dt * flow.at(middle, t + 0.5 / steps);
                        }
                        result[n] = x - points[n];
                      }
                    });
  return result;
}

std::optional<double> explainedShare(const std::vector<Vec3d>& points, const std::vector<Vec3d>& displacement,
                                     const openvdb::FloatGrid& phi) {
  const std::vector<double> after = distances(points, displacement, 1.0, phi),
                            before = distances(points, displacement, 0.0, phi);
  const double least = kMoved * phi.voxelSize()[0];
  double left = 0.0, all = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (before[n] < least) continue;
    left += after[n] * after[n];
    all += before[n] * before[n];
    ++count;
  }
  if (count < kFewestPoints) return std::nullopt;
  return 1.0 - left / all;
}

FrameMotion bestMotion(const openvdb::FloatGrid& last, const openvdb::FloatGrid& phi,
                       const sim::FaceGrids& begin, const sim::FaceGrids& end, double seconds) {
  std::vector<Vec3d> points = surfacePoints(last, kPoints);
  keepMoved(phi, points);
  FrameMotion best;
  for (const double weight : {0.5, 0.25, 0.75, 0.0, 1.0}) {
    const std::optional<double> explained =
        explainedShare(points, displacements(points, begin, end, weight, seconds), phi);
    if (!explained) continue;
    const double least = best.explained.value_or(-1e30) + (best.meanWeight == 0.5 ? kBetter : 0.0);
    if (!best.explained || *explained > least) best = {weight, explained};
  }
  return best;
}

std::optional<VelocityFactor> bestFactor(const openvdb::FloatGrid& last, const openvdb::FloatGrid& phi,
                                         const sim::FaceGrids& begin, const sim::FaceGrids& end,
                                         double meanWeight, double seconds) {
  std::vector<Vec3d> points = surfacePoints(last, kPoints);
  keepMoved(phi, points);
  if (points.size() < kFewestPoints) return std::nullopt;
  const auto traced = [&](double factor) {
    return mean(distances(points, displacements(points, begin, end, meanWeight, factor * seconds), 1.0, phi));
  };
  // First along straight lines, since paths of velocities that are much too fast leave what is known; evenly
  // in the logarithm, in steps of 2.4%.
  const std::vector<Vec3d> straight = displacements(points, begin, end, meanWeight, kShort * seconds);
  constexpr int kSteps = 240;
  const double largest = std::log(300.0);
  double best = 0.0, least = std::numeric_limits<double>::max();
  for (int n = -kSteps; n <= kSteps; ++n) {
    const double at = largest * n / kSteps;
    const double here = mean(distances(points, straight, std::exp(at) / kShort, phi));
    if (here < least) {
      least = here;
      best = at;
    }
  }
  const double asIs = traced(1.0);
  least = traced(std::exp(best));
  if (asIs < least) {
    least = asIs;
    best = 0.0;
  }
  // Then finer, and as they are traced.
  for (double width = 0.1; width > 2e-3; width *= 0.5)
    for (const double side : {-1.0, 1.0}) {
      const double here = traced(std::exp(best + side * width));
      if (here >= least) continue;
      least = here;
      best += side * width;
      break;
    }
  const double h = phi.voxelSize()[0];
  const std::vector<Vec3d> none(points.size(), Vec3d(0.0));
  return VelocityFactor{std::exp(best), least / h, asIs / h, mean(distances(points, none, 1.0, phi)) / h};
}

}  // namespace fluidtex::caches
