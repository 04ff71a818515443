#include "caches/liquid/particles.h"

#include "caches/liquid/particle_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;
using Leaf = openvdb::FloatTree::LeafNodeType;

// In particle spacings: side of the voxels, and how far particles count for the mean place around.
constexpr double kVoxel = 1.0, kSurfaceReach = 2.5;
// How far the mean place of a half-space is from its flat end, in reaches, with weights (1 - r^2)^3 (the two
// integrals are 1/40 and 16/315), and so what of that is taken off.
constexpr double kMeanPlace = 0.5 * (1.0 / 40.0) / (16.0 / 315.0);
// Between two bodies the mean place is near, too: liquid has a particle within so many spacings.
constexpr double kNearest = 1.25;
// Where the field is below this share of the lowest, all around is liquid, or nearly.
constexpr double kDeepShare = 0.6;

// Density of particles: radius in which they count, in spacings; how many are asked, and what share of these
// has neighbours to all sides at least; how often the radius is set anew.
constexpr double kDensityReach = 3.0;
constexpr std::size_t kAsked = 2000;
constexpr double kInside = 0.2;
constexpr int kRounds = 6;

// Particles a volume at a place, weighted by (1 - (r / reach)^2)^3.
double densityAt(const Vec3d& x, const ParticleCells& cells) {
  double sum = 0.0;
  ParticleCells::Window(cells, x, x).near(x, [&](std::uint32_t, const Vec3d&, double s) {
    sum += s * s * s;
  });
  return sum * 315.0 / (64.0 * std::numbers::pi) / std::pow(cells.reach(), 3);
}

// Below 0 inside; where no particle counts it is `outside`.
double fieldAt(const Vec3d& x, const ParticleCells::Window& around, double spacing, double outside) {
  double weights = 0.0, nearest = outside * outside;
  Vec3d sum(0.0);
  around.near(x, [&](std::uint32_t, const Vec3d& d, double s) {
    const double weight = s * s * s;
    weights += weight;
    sum += weight * d;
    nearest = std::min(nearest, d.lengthSqr());
  });
  if (weights <= 0.0) return outside;
  const double off = sum.length() / weights - kMeanPlace * kSurfaceReach * spacing;
  return std::max(off, std::sqrt(nearest) - kNearest * spacing);
}

// The places of every second voxel of a leaf, up to those of the next: all deep inside?
template <class Field>
bool isDeep(const Coord& origin, double deep, const Field& field) {
  for (int i = 0; i <= int(Leaf::DIM); i += 2)
    for (int j = 0; j <= int(Leaf::DIM); j += 2)
      for (int k = 0; k <= int(Leaf::DIM); k += 2)
        if (field(origin.offsetBy(i, j, k)) > deep) return false;
  return true;
}

// Leaves of all voxels within the reach of particles.
void touchLeaves(const std::vector<Vec3f>& points, double voxel, double reach, openvdb::FloatTree& tree) {
  openvdb::tree::ValueAccessor<openvdb::FloatTree> leaves(tree);
  for (const Vec3f& x : points) {
    const Coord low = Coord::floor((Vec3d(x) - Vec3d(reach)) / voxel) & ~(Leaf::DIM - 1),
                high = Coord::floor((Vec3d(x) + Vec3d(reach)) / voxel) & ~(Leaf::DIM - 1);
    for (int i = low[0]; i <= high[0]; i += int(Leaf::DIM))
      for (int j = low[1]; j <= high[1]; j += int(Leaf::DIM))
        for (int k = low[2]; k <= high[2]; k += int(Leaf::DIM)) leaves.touchLeaf(Coord(i, j, k));
  }
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
    const ParticleCells cells(points, kDensityReach * spacing);
    const std::size_t stride = 1 + (points.size() - 1) / kAsked;
    std::vector<double> densities((points.size() - 1) / stride + 1);
    tbb::parallel_for(std::size_t{0}, densities.size(),
                      [&](std::size_t n) { densities[n] = densityAt(Vec3d(points[n * stride]), cells); });
    const auto inside = densities.begin() + std::ptrdiff_t((1.0 - kInside) * double(densities.size() - 1));
    std::nth_element(densities.begin(), inside, densities.end());
    const double last = std::exchange(spacing, 1.0 / std::cbrt(*inside));
    if (std::abs(spacing - last) < 0.01 * last) break;
  }
  return spacing;
}

SurfaceTriangles surfaceOfParticles(const std::vector<Vec3f>& points, double spacing) {
  if (points.empty() || !(spacing > 0.0)) return {};
  const double voxel = kVoxel * spacing, reach = kSurfaceReach * spacing, outside = reach;
  const double deepest = -kMeanPlace * reach;
  const ParticleCells cells(points, reach);
  openvdb::FloatGrid phi{float(outside)};
  phi.setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  touchLeaves(points, voxel, reach, phi.tree());
  std::vector<Leaf*> leaves;
  phi.tree().getNodes(leaves);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord origin = leaves[n]->origin();
    const ParticleCells::Window around(cells, origin.asVec3d() * voxel,
                                       origin.offsetBy(int(Leaf::DIM)).asVec3d() * voxel);
    const auto field = [&](const Coord& at) {
      return fieldAt(at.asVec3d() * voxel, around, spacing, outside);
    };
    if (isDeep(origin, kDeepShare * deepest, field)) {
      leaves[n]->fill(float(deepest), false);
      return;
    }
    for (auto value = leaves[n]->beginValueAll(); value; ++value) {
      const double here = field(value.getCoord());
      value.setValue(float(here));
      value.setValueOn(std::abs(here) < outside);
    }
  });
  return surfaceOfGrid(phi, 0.0);
}

}  // namespace fluidtex::caches
