#include "caches/liquid/particles.h"

#include "caches/liquid/continue_outwards.h"
#include "caches/liquid/level_set.h"

#include <openvdb/tools/Filter.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/ParticlesToLevelSet.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>
#include <utility>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

// In particle spacings: radius of the balls, side of the voxels, and how far the smoothed surface of the
// balls is drawn in, so that it lies half a spacing outside of the centres.
constexpr double kBall = 1.0, kVoxel = 0.5, kDrawnIn = 0.45;
constexpr int kSmoothings = 4;
constexpr int kLayers = 3;
// Velocity of particles: radius in which they count, in spacings; the weight below which nothing is known;
// and what is added to their spread, in squared spacings, so that few of them make no slope.
constexpr double kVelocityReach = 3.0, kLeastWeight = 1e-3, kLeastSpread = 0.01;
// Of the velocities around a place, that its own may lie from their mean.
constexpr double kMostDeviations = 3.0;
// Density of particles: radius in which they count, in spacings; how many are asked, and what share of these
// has neighbours to all sides at least; how often the radius is set anew.
constexpr double kReach = 3.0;
constexpr std::size_t kAsked = 2000;
constexpr double kInside = 0.2;
constexpr int kRounds = 6;

// As the library asks for them.
struct Balls {
  using PosType = openvdb::Vec3R;
  const std::vector<Vec3f>& points;
  double radius;

  std::size_t size() const { return points.size(); }
  void getPos(std::size_t n, PosType& x) const { x = PosType(points[n]); }
  void getPosRad(std::size_t n, PosType& x, openvdb::Real& r) const {
    x = PosType(points[n]);
    r = radius;
  }
};

struct CoordHash {
  std::size_t operator()(const Coord& c) const { return c.hash<20>(); }
};

// Particles in buckets of side `side`, each with the next of its bucket.
class Buckets {
 public:
  Buckets(const std::vector<Vec3f>& points, double side) : m_points(points), m_side(side) {
    m_next.reserve(points.size());
    for (std::uint32_t n = 0; n < points.size(); ++n) {
      const auto [bucket, isNew] = m_first.emplace(Coord::floor(Vec3d(points[n]) / side), n);
      m_next.push_back(isNew ? kNone : std::exchange(bucket->second, n));
    }
  }

  // Calls visit(n, 1 - (r / side)^2) for the particles within r < side of a place.
  template <class Visit>
  void near(const Vec3d& x, const Visit& visit) const {
    const Coord middle = Coord::floor(x / m_side);
    for (int n = 0; n < 27; ++n) {
      const auto bucket = m_first.find(middle.offsetBy(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1));
      if (bucket == m_first.end()) continue;
      for (std::uint32_t p = bucket->second; p != kNone; p = m_next[p])
        if (const double left = 1.0 - (Vec3d(m_points[p]) - x).lengthSqr() / (m_side * m_side); left > 0.0)
          visit(p, left);
    }
  }

  // Particles a volume at a place, weighted by (1 - (r / side)^2)^3.
  double densityAt(const Vec3d& x) const {
    double sum = 0.0;
    near(x, [&](std::uint32_t, double left) { sum += left * left * left; });
    return sum * 315.0 / (64.0 * std::numbers::pi) / (m_side * m_side * m_side);
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  const std::vector<Vec3f>& m_points;
  double m_side;
  std::unordered_map<Coord, std::uint32_t, CoordHash> m_first;
  std::vector<std::uint32_t> m_next;
};

// The value at x of the linear field that fits the velocities around it best (moving least squares), which
// holds at the surface too, where all particles are to one side.
bool velocityAt(const Vec3d& x, const Buckets& buckets, const std::vector<Vec3f>& points,
                const std::vector<float>& velocity, double spacing, Vec3d& result) {
  double weights = 0.0, squaredSpeed = 0.0;
  Vec3d middle(0.0), mean(0.0);
  Mat3d squares = Mat3d::zero(), both = Mat3d::zero();
  buckets.near(x, [&](std::uint32_t n, double weight) {
    const Vec3d d = (Vec3d(points[n]) - x) / spacing;
    const Vec3d v(velocity[3 * n], velocity[3 * n + 1], velocity[3 * n + 2]);
    weights += weight;
    middle += weight * d;
    mean += weight * v;
    squaredSpeed += weight * v.lengthSqr();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        squares[i][j] += weight * d[i] * d[j];
        both[i][j] += weight * v[i] * d[j];
      }
  });
  if (weights < kLeastWeight) return false;
  middle /= weights;
  mean /= weights;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      squares[i][j] = squares[i][j] / weights - middle[i] * middle[j] + (i == j ? kLeastSpread : 0.0);
      both[i][j] = both[i][j] / weights - mean[i] * middle[j];
    }
  // No farther from the mean than some deviations: where few particles of a splash fly apart, the slope means
  // nothing.
  const double most = kMostDeviations * std::sqrt(std::max(squaredSpeed / weights - mean.lengthSqr(), 0.0));
  Vec3d slope = both * squares.inverse() * middle;
  if (const double length = slope.length(); length > most) slope *= most / length;
  result = mean - slope;
  return true;
}

}  // namespace

double particleSpacing(const std::vector<Vec3f>& points) {
  if (points.size() < 2) return 0.0;
  openvdb::BBoxd bounds;
  for (const Vec3f& x : points) bounds.expand(Vec3d(x));
  const Vec3d size = bounds.extents();
  const double longest = std::max({size[0], size[1], size[2]});
  if (!(longest > 0.0)) return 0.0;
  // As if the particles filled their bounds, or a sheet or thread of it; then by their density.
  double volume = 1.0;
  for (const double length : {size[0], size[1], size[2]}) volume *= std::max(length, 1e-3 * longest);
  double spacing = std::cbrt(volume / double(points.size()));
  for (int round = 0; round < kRounds; ++round) {
    const Buckets buckets(points, kReach * spacing);
    std::vector<double> densities;
    const std::size_t stride = 1 + (points.size() - 1) / kAsked;
    for (std::size_t n = 0; n < points.size(); n += stride)
      densities.push_back(buckets.densityAt(Vec3d(points[n])));
    const auto inside = densities.begin() + std::ptrdiff_t((1.0 - kInside) * double(densities.size() - 1));
    std::nth_element(densities.begin(), inside, densities.end());
    const double last = std::exchange(spacing, 1.0 / std::cbrt(*inside));
    if (std::abs(spacing - last) < 0.01 * last) break;
  }
  return spacing;
}

SurfaceTriangles surfaceOfParticles(const std::vector<Vec3f>& points, double spacing) {
  if (points.empty() || !(spacing > 0.0)) return {};
  const double voxel = kVoxel * spacing;
  const openvdb::FloatGrid::Ptr phi = openvdb::createLevelSet<openvdb::FloatGrid>(voxel, 4.0);
  openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> raster(*phi);
  raster.setRmin(0.0);
  raster.rasterizeSpheres(Balls{points, kBall * spacing});
  raster.finalize(true);
  // Inside of the balls their distances are those to single balls; made anew, they can be smoothed and cut.
  const openvdb::FloatGrid::Ptr smooth = levelSetOf(surfaceOfGrid(*phi, 0.0), voxel).phi;
  openvdb::tools::Filter<openvdb::FloatGrid>(*smooth).mean(1, kSmoothings);
  return surfaceOfGrid(*smooth, -kDrawnIn * spacing);
}

openvdb::Vec3SGrid::Ptr velocityOfParticles(const std::vector<Vec3f>& points,
                                            const std::vector<float>& velocity, double spacing) {
  const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->setTransform(openvdb::math::Transform::createLinearTransform(spacing));
  if (points.empty() || !(spacing > 0.0)) return grid;
  openvdb::MaskTree near;
  for (const Vec3f& x : points) near.setValueOn(Coord::round(Vec3d(x) / spacing));
  openvdb::tools::dilateActiveValues(near, 2, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::EXPAND_TILES);
  near.voxelizeActiveTiles();
  grid->tree().topologyUnion(near);
  std::vector<openvdb::Vec3STree::LeafNodeType*> leaves;
  grid->tree().getNodes(leaves);
  const Buckets buckets(points, kVelocityReach * spacing);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (auto voxel = leaves[n]->beginValueOn(); voxel; ++voxel) {
      Vec3d v;
      if (velocityAt(voxel.getCoord().asVec3d() * spacing, buckets, points, velocity, spacing, v))
        voxel.setValue(Vec3f(v));
      else
        voxel.setValueOff();
    }
  });
  continueOutwards(*grid, kLayers);
  return grid;
}

}  // namespace fluidtex::caches
