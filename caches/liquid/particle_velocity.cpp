#include "caches/liquid/particle_velocity.h"

#include "caches/liquid/continue_outwards.h"
#include "caches/liquid/particle_cells.h"
#include "sim/grid/dilate.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Radius in which particles count, in spacings; the weight below which nothing is known; and what is added to
// the spread of the particles, as a share of it and at least, so that those of a plane or a line give a slope
// along it.
constexpr double kFitReach = 4.0, kLeastWeight = 1e-3, kSpreadShare = 1e-6, kLeastSpread = 1e-12;
// That radius where too few particles are within the other, and how many voxels beyond the particles it
// serves.
constexpr double kWideReach = 6.0;
constexpr int kBeyond = 3;
// Particles of equal weight that it takes to know a slope and what it leaves: twice those that a linear field
// fits without error.
constexpr double kFewestParticles = 8.0;
// With fewer than this many, those in the wide radius are asked.
constexpr double kMany = 12.0;
// Power of the share of the velocities' spread that the fit explains, by which it may be faster than all
// around.
constexpr double kTrust = 8.0;

// What is usual around a place: side of the grid of places and radius around them, in spacings; and how many
// usual differences from the median are much, of which the weight is kLike.
constexpr double kUsualVoxel = 2.0, kUsualReach = 4.0, kMuch = 3.0;
constexpr float kLike = 0.25f;

struct Usual {
  Vec3f median{0.0f};
  float difference = 0.0f;  // median of the distances from it
  std::size_t count = 0;    // of particles
};

float medianOf(std::vector<float>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Usual usualOf(const std::vector<Vec3f>& around, std::vector<float>& values) {
  Usual usual;
  usual.count = around.size();
  if (around.empty()) return usual;
  values.resize(around.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < around.size(); ++n) values[n] = around[n][axis];
    usual.median[axis] = medianOf(values);
  }
  for (std::size_t n = 0; n < around.size(); ++n) values[n] = (around[n] - usual.median).length();
  usual.difference = medianOf(values);
  return usual;
}

// Weight of each particle (#P): less, the farther its velocity is from what is usual at that place next to it
// around which most particles are, which is the one that is deepest inside. FLIP's particles at walls keep
// velocities of old, ten times those with which they move, and a layer of them would lead away all above it.
std::vector<float> likeness(const std::vector<Vec3f>& points, const std::vector<float>& velocity,
                            double spacing) {
  const double voxel = kUsualVoxel * spacing;
  openvdb::Int32Tree places(-1);
  for (const Vec3f& x : points) {
    const Coord low = Coord::floor(Vec3d(x) / voxel);
    for (int n = 0; n < 8; ++n) places.setValueOn(low.offsetBy(n >> 2, n >> 1 & 1, n & 1), 0);
  }
  std::vector<openvdb::Int32Tree::LeafNodeType*> leaves;
  places.getNodes(leaves);
  std::vector<std::size_t> first(leaves.size() + 1, 0);
  for (std::size_t n = 0; n < leaves.size(); ++n) first[n + 1] = first[n] + leaves[n]->onVoxelCount();
  std::vector<Usual> usual(first.back());
  const ParticleCells cells(points, kUsualReach * spacing);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord origin = leaves[n]->origin();
    const ParticleCells::Window window(
        cells, origin.asVec3d() * voxel,
        origin.offsetBy(int(openvdb::Int32Tree::LeafNodeType::DIM)).asVec3d() * voxel);
    std::vector<Vec3f> around;
    std::vector<float> values;
    std::size_t at = first[n];
    for (auto place = leaves[n]->beginValueOn(); place; ++place) {
      around.clear();
      window.near(place.getCoord().asVec3d() * voxel, [&](std::uint32_t p, const Vec3d&, double) {
        around.emplace_back(&velocity[3 * cells.order()[p]]);
      });
      usual[at] = usualOf(around, values);
      place.setValue(int(at++));
    }
  });
  std::vector<float> result(points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const openvdb::tree::ValueAccessor<const openvdb::Int32Tree> placeAt(places);
                      for (std::size_t p = range.begin(); p != range.end(); ++p) {
                        const Coord low = Coord::floor(Vec3d(points[p]) / voxel);
                        Usual best;
                        for (int n = 0; n < 8; ++n) {
                          const int place = placeAt.getValue(low.offsetBy(n >> 2, n >> 1 & 1, n & 1));
                          if (usual[std::size_t(place)].count > best.count) best = usual[std::size_t(place)];
                        }
                        const double much =
                            kMuch * (double(best.difference) + 1e-6 * double(best.median.length()) + 1e-30);
                        const double off = double((Vec3f(&velocity[3 * p]) - best.median).length()) / much;
                        result[p] = float(std::pow(1.0 + off * off, -2.0));
                      }
                    });
  return result;
}

// Sums over the particles around a place; lengths in reaches.
struct Around {
  double weights = 0.0, squaredWeights = 0.0, squaredSpeed = 0.0, fastest = 0.0;
  Vec3d middle{0.0}, mean{0.0};
  Mat3d squares = Mat3d::zero(), both = Mat3d::zero();

  void add(double weight, const Vec3d& d, const Vec3d& v, bool isLike) {
    weights += weight;
    squaredWeights += weight * weight;
    squaredSpeed += weight * v.lengthSqr();
    if (isLike) fastest = std::max(fastest, v.lengthSqr());
    middle += weight * d;
    mean += weight * v;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if (j <= i) squares[i][j] += weight * d[i] * d[j];
        both[i][j] += weight * v[i] * d[j];
      }
  }

  double count() const { return weights > 0.0 ? weights * weights / squaredWeights : 0.0; }

  // Sums become means, and the spreads those about the means.
  void finish() {
    middle /= weights;
    mean /= weights;
    squaredSpeed = std::max(squaredSpeed / weights - mean.lengthSqr(), 0.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        both[i][j] = both[i][j] / weights - mean[i] * middle[j];
        if (j <= i) squares[i][j] = squares[j][i] = squares[i][j] / weights - middle[i] * middle[j];
      }
    const double least = kSpreadShare * (squares[0][0] + squares[1][1] + squares[2][2]) + kLeastSpread;
    for (int i = 0; i < 3; ++i) squares[i][i] += least;
  }
};

// The fit's value at the place itself.
Vec3d valueOf(const Around& around) {
  const double count = around.count();
  if (count <= kFewestParticles || around.squaredSpeed == 0.0) return around.mean;
  const Mat3d inverse = around.squares.inverse();
  const Mat3d slope = around.both * inverse;
  const Vec3d off = slope * around.middle;
  // What the fit leaves of the velocities is taken for chance. So much of it is in the slope, and what the
  // slope says beyond it is kept.
  double fitted = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) fitted += slope[i][j] * around.both[i][j];
  const double left = std::max(around.squaredSpeed - fitted, 0.0) / (count - kFewestParticles);
  const double chance = left * around.middle.dot(inverse * around.middle), all = off.lengthSqr();
  if (all <= chance) return around.mean;
  const Vec3d value = around.mean - (1.0 - chance / all) * off;
  // Velocities that turn or stretch go on to grow beyond the outermost particle, those in disorder do not.
  const double speed = value.length(), fastest = std::sqrt(around.fastest);
  if (speed <= fastest) return value;
  const double trust = std::pow(std::max(1.0 - count * left / around.squaredSpeed, 0.0), kTrust);
  return value * ((fastest + trust * (speed - fastest)) / speed);
}

// Particles in cells, with what is asked of each.
struct MovingParticles {
  struct One {
    Vec3f velocity;
    float weight;
  };

  MovingParticles(const std::vector<Vec3f>& points, const std::vector<float>& velocity,
                  const std::vector<float>& weights, double reach)
      : cells(points, reach) {
    sorted.reserve(points.size());
    for (const std::uint32_t n : cells.order()) sorted.push_back({Vec3f(&velocity[3 * n]), weights[n]});
  }

  Around around(const Vec3d& x, const ParticleCells::Window& window) const {
    Around result;
    window.near(x, [&](std::uint32_t n, const Vec3d& d, double s) {
      const One& one = sorted[n];
      result.add(s * one.weight, d / cells.reach(), Vec3d(one.velocity), one.weight > kLike);
    });
    return result;
  }

  ParticleCells cells;
  std::vector<One> sorted;
};

}  // namespace

openvdb::Vec3SGrid::Ptr velocityOfParticles(const std::vector<Vec3f>& points,
                                            const std::vector<float>& velocity, double spacing) {
  const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(spacing));
  if (points.empty() || !(spacing > 0.0)) return grid;
  openvdb::MaskTree known;
  for (const Vec3f& x : points) known.setValueOn(Coord::round(Vec3d(x) / spacing));
  openvdb::tools::dilateActiveValues(known, kBeyond, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::EXPAND_TILES);
  known.voxelizeActiveTiles();
  grid->tree().topologyUnion(known);
  std::vector<openvdb::Vec3STree::LeafNodeType*> leaves;
  grid->tree().getNodes(leaves);
  const std::vector<float> weights = likeness(points, velocity, spacing);
  const MovingParticles near(points, velocity, weights, kFitReach * spacing),
      wide(points, velocity, weights, kWideReach * spacing);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord origin = leaves[n]->origin();
    const Vec3d low = origin.asVec3d() * spacing,
                high = origin.offsetBy(int(openvdb::Vec3STree::LeafNodeType::DIM)).asVec3d() * spacing;
    const ParticleCells::Window nearWindow(near.cells, low, high), wideWindow(wide.cells, low, high);
    for (auto voxel = leaves[n]->beginValueOn(); voxel; ++voxel) {
      const Vec3d x = voxel.getCoord().asVec3d() * spacing;
      Around around = near.around(x, nearWindow);
      if (around.count() < kMany) around = wide.around(x, wideWindow);
      if (around.weights < kLeastWeight) {
        voxel.setValueOff();
        continue;
      }
      around.finish();
      voxel.setValue(Vec3f(valueOf(around)));
    }
  });
  continueOutwards(*grid, kContinuedLayers);
  return grid;
}

}  // namespace fluidtex::caches
