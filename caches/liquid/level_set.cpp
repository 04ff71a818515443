#include "caches/liquid/level_set.h"

#include "sim/grid/mac_grid.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/ValueTransformer.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;

// Half the thickness of a surface that encloses nothing, cells.
constexpr double kSheet = 0.75;

// Triangles as the library asks for them: in index space.
struct Triangles {
  const SurfaceTriangles& surface;
  double h;

  std::size_t polygonCount() const { return surface.triangles.size(); }
  std::size_t pointCount() const { return surface.points.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, Vec3d& x) const {
    x = Vec3d(surface.points[surface.triangles[polygon][int(corner)]]) / h - Vec3d(0.5);
  }
};

bool enclosesNothing(const openvdb::FloatGrid& phi, double h) {
  for (auto leaf = phi.tree().cbeginLeaf(); leaf; ++leaf)
    for (auto value = leaf->cbeginValueOn(); value; ++value)
      if (*value < -0.1f * float(h)) return false;
  return true;
}

}  // namespace

LevelSet levelSetOf(const SurfaceTriangles& surface, double h) {
  const openvdb::math::Transform::Ptr transform = sim::cellTransform(h);
  const Triangles triangles{surface, h};
  LevelSet result;
  if (surface.triangles.empty()) {
    result.phi = openvdb::createLevelSet<openvdb::FloatGrid>(h, kBand);
    result.phi->setTransform(transform);
    return result;
  }
  result.phi = openvdb::tools::meshToVolume<openvdb::FloatGrid>(triangles, *transform, kBand, kBand);
  result.isSheet = enclosesNothing(*result.phi, h);
  if (result.isSheet) {
    result.phi = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
        triangles, *transform, kBand + kSheet, kBand, openvdb::tools::UNSIGNED_DISTANCE_FIELD);
    const float half = float(kSheet * h);
    openvdb::tools::foreach (result.phi->beginValueAll(),
                             [half](const auto& value) { value.setValue(*value - half); });
    openvdb::tools::changeBackground(result.phi->tree(), float(kBand * h));
  }
  result.phi->setGridClass(openvdb::GRID_LEVEL_SET);
  result.phi->setTransform(transform);
  return result;
}

std::vector<openvdb::FloatGrid::Ptr> continuedOff(const SurfaceTriangles& surface,
                                                  const std::vector<float>& values, int components, double h,
                                                  int band) {
  std::vector<openvdb::FloatGrid::Ptr> result;
  for (int c = 0; c < components; ++c) {
    result.push_back(openvdb::FloatGrid::create(0.0f));
    result.back()->setTransform(sim::cellTransform(h));
  }
  if (surface.triangles.empty()) return result;
  const openvdb::math::Transform::Ptr transform = sim::cellTransform(h);
  openvdb::Int32Grid closest(openvdb::Int32(openvdb::util::INVALID_IDX));
  openvdb::tools::meshToVolume<openvdb::FloatGrid>(Triangles{surface, h}, *transform, float(band),
                                                   float(band), openvdb::tools::UNSIGNED_DISTANCE_FIELD,
                                                   &closest);
  std::vector<const openvdb::Int32Tree::LeafNodeType*> leaves;
  closest.tree().getNodes(leaves);
  std::vector<std::vector<openvdb::FloatTree::LeafNodeType*>> made(
      std::size_t(components), std::vector<openvdb::FloatTree::LeafNodeType*>(leaves.size()));
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (int c = 0; c < components; ++c)
      made[c][n] = new openvdb::FloatTree::LeafNodeType(leaves[n]->origin(), 0.0f, false);
    for (auto index = leaves[n]->cbeginValueOn(); index; ++index) {
      if (*index < 0 || std::size_t(*index) >= surface.triangles.size()) continue;
      const Vec3I& t = surface.triangles[std::size_t(*index)];
      const Vec3d x = transform->indexToWorld(index.getCoord());
      Vec3d weights;
      openvdb::math::closestPointOnTriangleToPoint(Vec3d(surface.points[t[0]]), Vec3d(surface.points[t[1]]),
                                                   Vec3d(surface.points[t[2]]), x, weights);
      for (int c = 0; c < components; ++c) {
        double value = 0.0;
        for (int corner = 0; corner < 3; ++corner)
          value += weights[corner] * values[std::size_t(t[corner]) * components + c];
        if (std::isfinite(value)) made[c][n]->setValueOn(index.pos(), float(value));
      }
    }
  });
  for (int c = 0; c < components; ++c)
    for (auto* leaf : made[c]) result[c]->tree().addLeaf(leaf);
  return result;
}

}  // namespace fluidtex::caches
