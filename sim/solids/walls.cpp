// Slip lengths: Navier, "Memoire sur les lois du mouvement des fluides", 1823.
#include "sim/solids/walls.h"

#include "sim/grid/normal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::sim {
namespace {

constexpr float kFree = std::numeric_limits<float>::infinity();

// Leaves of solid.phi that hold a surface.
std::vector<Coord> surfaceBlocks(const SolidField& field) {
  std::vector<Coord> origins;
  for (auto leaf = field.phi->constTree().cbeginLeaf(); leaf; ++leaf) origins.push_back(leaf->origin());
  return origins;
}

}  // namespace

bool grips(const Wall& wall) {
  return wall.kind != WallKind::slip;
}

double slipLength(const Wall& wall) {
  if (wall.kind == WallKind::slip) return std::numeric_limits<double>::infinity();
  return wall.kind == WallKind::noSlip ? 0.0 : wall.slipLength;
}

void setWalls(SolidField& field, const std::function<const Wall&(const Vec3d&)>& wallAt,
              const std::function<double(const Vec3d&)>& distance) {
  const double h = field.voxelSize;
  const std::vector<Coord> origins = surfaceBlocks(field);
  field.slipLength = FloatGrid::create(kFree);
  field.slipLength->setTransform(cellTransform(h));
  for (int a = 0; a < 3; ++a) {
    field.slide.component[a] = FloatGrid::create(0.0f);
    field.slide.component[a]->setTransform(faceTransform(h, a));
  }
  std::vector<FloatLeaf*> slip;
  std::array<std::vector<FloatLeaf*>, 3> slide;
  for (const Coord& origin : origins) {
    slip.push_back(field.slipLength->tree().touchLeaf(origin));
    for (int a = 0; a < 3; ++a) slide[a].push_back(field.slide.component[a]->tree().touchLeaf(origin));
  }
  std::vector<char> sliding(origins.size(), 0);
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    const FloatLeaf& near = *field.phi->constTree().probeConstLeaf(origins[n]);
    for (auto it = near.cbeginValueOn(); it; ++it) {
      slip[n]->setValueOn(it.pos(),
                          static_cast<float>(slipLength(wallAt(field.phi->indexToWorld(it.getCoord())))));
      for (int a = 0; a < 3; ++a) {
        const Vec3d x = field.slide.component[a]->indexToWorld(it.getCoord());
        const Wall& wall = wallAt(x);
        if (!grips(wall) || wall.velocity.length() == 0.0) continue;
        const Vec3d normal = normalAt(distance, x, 0.1 * h);
        const double along = wall.velocity[a] - wall.velocity.dot(normal) * normal[a];
        slide[a][n]->setValueOn(it.pos(), static_cast<float>(along));
        sliding[n] = 1;
      }
    }
  });
  if (std::none_of(sliding.begin(), sliding.end(), [](char c) { return c != 0; })) field.slide = {};
}

void stickToWalls(Velocity& velocity, const SolidField& solid, const FaceMasks& valid) {
  if (!solid.slipLength) return;
  const float h = static_cast<float>(solid.voxelSize);
  const auto& masks = valid.component;
  for (int axis = 0; axis < 3; ++axis) {
    const auto leaves = leavesOf(velocity.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      using Accessor = openvdb::tree::ValueAccessor<const FloatTree>;
      const Accessor distance(solid.phi->constTree()), slip(solid.slipLength->constTree());
      const auto& known = masks[axis]->constTree();
      for (auto it = leaves[n]->beginValueOn(); it; ++it) {
        const Coord face = it.getCoord();
        Coord below = face;
        below[axis] -= 1;
        const float d0 = distance.getValue(below), d1 = distance.getValue(face);
        const float depth = -0.5f * (d0 + d1) / h;
        if (depth < 0.0f) continue;
        const float slipHere = slip.getValue(d1 < d0 ? face : below) / h;
        if (!std::isfinite(slipHere)) continue;
        if (solid.open[axis].constTree().getValue(face) >= kLeastOpen || known.isValueOn(face)) continue;
        float wall = 0.0f;
        if (solid.speed) wall += solid.speed[axis].constTree().getValue(face);
        if (solid.slide) wall += solid.slide[axis].constTree().getValue(face);
        // The value is extrapolated from the liquid's last face, which lies a whole number of cells away.
        // Where the profile is steep beside that face, it is limited to the mirror image.
        const float beyond = std::ceil(depth + 1e-3f) - depth;
        const float factor = std::clamp((slipHere - depth) / (slipHere + beyond), -1.0f, 1.0f);
        it.setValue(wall + factor * (*it - wall));
      }
    });
  }
}

}  // namespace fluidtex::sim
