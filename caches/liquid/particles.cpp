#include "caches/liquid/particles.h"

#include "caches/liquid/velocity_grids.h"

#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/ParticlesToLevelSet.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

// In particle spacings: radius of the balls, side of the voxels, and how far the smoothed surface of the
// balls is drawn in, so that it lies half a spacing outside of the centres.
constexpr double kBall = 1.0, kVoxel = 0.5, kDrawnIn = 0.45;
constexpr int kSmoothings = 3;
constexpr int kLayers = 3;
// Particles that a bucket should hold when their density is taken, and how often its size is set anew.
constexpr double kInBucket = 27.0;
constexpr int kRounds = 4;

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

}  // namespace

double particleSpacing(const std::vector<Vec3f>& points) {
  if (points.size() < 2) return 0.0;
  openvdb::BBoxd bounds;
  for (const Vec3f& x : points) bounds.expand(Vec3d(x));
  const Vec3d size = bounds.extents();
  const double longest = std::max({size[0], size[1], size[2]});
  if (!(longest > 0.0)) return 0.0;
  // As if the particles filled their bounds; then buckets of about kInBucket where most particles are.
  double side = longest;
  for (const double length : {size[0], size[1], size[2]})
    side = std::min(side, std::cbrt(longest * longest * std::max(length, 1e-3 * longest)));
  side *= std::cbrt(kInBucket / double(points.size()));
  double inBucket = kInBucket;
  for (int round = 0; round < kRounds; ++round) {
    std::unordered_map<Coord, std::uint32_t, CoordHash> counts;
    for (const Vec3f& x : points) ++counts[Coord::floor(Vec3d(x) / side)];
    std::vector<std::uint32_t> around;  // of each particle
    around.reserve(points.size());
    for (const auto& [bucket, count] : counts) around.insert(around.end(), count, count);
    const auto middle = around.begin() + std::ptrdiff_t(around.size() / 2);
    std::nth_element(around.begin(), middle, around.end());
    inBucket = double(*middle);
    if (round + 1 < kRounds) side *= std::cbrt(kInBucket / inBucket);
  }
  return side / std::cbrt(inBucket);
}

SurfaceTriangles surfaceOfParticles(const std::vector<Vec3f>& points, double spacing) {
  if (points.empty() || !(spacing > 0.0)) return {};
  const double voxel = kVoxel * spacing;
  const openvdb::FloatGrid::Ptr phi = openvdb::createLevelSet<openvdb::FloatGrid>(voxel, 4.0);
  openvdb::tools::ParticlesToLevelSet<openvdb::FloatGrid> raster(*phi);
  raster.setRmin(0.0);
  raster.rasterizeSpheres(Balls{points, kBall * spacing});
  raster.finalize(true);
  openvdb::tools::LevelSetFilter<openvdb::FloatGrid> filter(*phi);
  for (int n = 0; n < kSmoothings; ++n) filter.gaussian(1);
  filter.offset(float(kDrawnIn * spacing));
  return surfaceOfGrid(*phi, 0.0);
}

openvdb::Vec3SGrid::Ptr velocityOfParticles(const std::vector<Vec3f>& points,
                                            const std::vector<float>& velocity, double spacing) {
  const openvdb::Vec3SGrid::Ptr sum = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  const openvdb::FloatGrid::Ptr weights = openvdb::FloatGrid::create(0.0f);
  sum->setTransform(openvdb::math::Transform::createLinearTransform(spacing));
  auto sums = sum->getAccessor();
  auto of = weights->getAccessor();
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Vec3d index = Vec3d(points[n]) / spacing;
    const Coord low = Coord::floor(index);
    const Vec3d t = index - low.asVec3d();
    const Vec3f v(velocity[3 * n], velocity[3 * n + 1], velocity[3 * n + 2]);
    for (int corner = 0; corner < 8; ++corner) {
      const Coord at = low.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1);
      const float weight = float((corner & 4 ? t[0] : 1.0 - t[0]) * (corner & 2 ? t[1] : 1.0 - t[1]) *
                                 (corner & 1 ? t[2] : 1.0 - t[2]));
      sums.setValue(at, sums.getValue(at) + weight * v);
      of.setValue(at, of.getValue(at) + weight);
    }
  }
  for (auto voxel = sum->beginValueOn(); voxel; ++voxel) {
    const float weight = of.getValue(voxel.getCoord());
    if (weight > 1e-3f)
      voxel.setValue(*voxel / weight);
    else
      voxel.setValueOff();
  }
  continueOutwards(*sum, kLayers);
  return sum;
}

}  // namespace fluidtex::caches
