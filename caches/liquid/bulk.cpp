#include "caches/liquid/bulk.h"

#include "sim/grid/dilate.h"

#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;

// From where liquid or air is deepest in what is just not thin, to the surface; one more where the two lie
// askew to the grid's axes.
constexpr int kDeepToSurface = kThin / 2 + 1;

void dilate(openvdb::MaskTree& mask, int cells) {
  openvdb::tools::dilateActiveValues(mask, cells, openvdb::tools::NN_FACE_EDGE_VERTEX);
}

// Cells at the surface of what is thin.
openvdb::MaskTree thinParts(const openvdb::FloatGrid& phi) {
  const double h = phi.voxelSize()[0];
  openvdb::MaskTree liquid, air, surface;
  for (auto leaf = phi.tree().cbeginLeaf(); leaf; ++leaf)
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      if (*value <= -0.5 * kThin * h) liquid.setValueOn(value.getCoord());
      if (*value >= 0.5 * kThin * h) air.setValueOn(value.getCoord());
      if (std::abs(*value) < 0.75 * h) surface.setValueOn(value.getCoord());
    }
  dilate(liquid, kDeepToSurface);
  dilate(air, kDeepToSurface);
  liquid.topologyIntersection(air);
  surface.topologyDifference(liquid);
  return surface;
}

}  // namespace

std::vector<bool> isInBulk(const openvdb::FloatGrid& phi, const std::vector<Vec3d>& places) {
  openvdb::MaskTree near = thinParts(phi);
  dilate(near, kClear);
  std::vector<bool> result(places.size());
  for (std::size_t n = 0; n < places.size(); ++n)
    result[n] = !near.isValueOn(Coord::round(phi.worldToIndex(places[n])));
  return result;
}

}  // namespace fluidtex::caches
