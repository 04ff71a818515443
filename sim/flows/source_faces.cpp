#include "sim/flows/source_faces.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/normal.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

// The farthest that a cell reaches from its centre, in cells.
constexpr float kFarthest = 0.87f;

// The velocities of a source at the faces of its cells. Its back is closed: under water, what leaves at the
// front would enter there. isIn: bool isIn(cell), whether a cell is the source's.
template <class IsIn>
class FaceSpeeds {
 public:
  FaceSpeeds(const Vec3d& velocity, const CoordBBox& domain, const IsIn& isIn)
      : m_velocity(velocity), m_domain(domain), m_isIn(isIn) {}

  // At the lower or upper face of one of its cells.
  float at(const Coord& cell, int axis, bool up) const {
    const float speed = static_cast<float>(m_velocity[axis]);
    Coord next = cell;
    next[axis] += up ? 1 : -1;
    return (up ? speed < 0.0f : speed > 0.0f) && isBack(next) ? 0.0f : speed;
  }

 private:
  bool isOutside(const Coord& cell) const { return m_domain.isInside(cell) && !m_isIn(cell); }

  // On a round front, a staircase of cells, what flows out of one step flows back into the next: only this
  // gives the flux of the front itself. Nothing flows into other outer faces.
  bool isFed(const Coord& cell) const {
    for (int axis = 0; axis < 3; ++axis) {
      Coord upstream = cell;
      upstream[axis] += m_velocity[axis] > 0.0 ? -1 : m_velocity[axis] < 0.0 ? 1 : 0;
      if (upstream != cell && m_domain.isInside(upstream) && m_isIn(upstream)) return true;
    }
    return false;
  }

  bool isBack(const Coord& cell) const { return isOutside(cell) && !isFed(cell); }

  Vec3d m_velocity;
  CoordBBox m_domain;
  const IsIn& m_isIn;
};

// In cells: what comes from a source nearer than kNearSolid to a solid finds no way between, nor does it in
// cells whose centre lies deeper than kSliver in the solid.
constexpr double kNearSolid = 0.5, kSliver = 0.25;

double between(double x, double a, double b) {
  return std::clamp(x, std::min(a, b), std::max(a, b));
}

// What a source gives in slivers, cells whose centre lies in a solid and not in the source.
// Those that it fills are its own: else all that its front gives would have to leave through them, beside
// walls into which it reaches. At the others, where the source is near the solid or the cell all but closed,
// it gives only what passes along the solid.
void giveSlivers(GivenFaces& given, const SourceGrids& source, double factor, const SolidField& solid) {
  const auto isIn = [&](const Coord& cell) { return isInSource(source, solid, cell); };
  const FaceSpeeds speeds(source.speed, solid.domain, isIn);
  const auto wall = solid.phi->getConstUnsafeAccessor();
  const double h = solid.voxelSize;
  for (auto leaf = source.phi->constTree().cbeginLeaf(); leaf; ++leaf) {
    const float* distance = leaf->buffer().data();
    for (int c = 0; c < kLeafSize; ++c) {
      const Coord cell = leaf->offsetToGlobalCoord(c);
      if (distance[c] < 0.0f || wall.getValue(cell) > 0.0f || !solid.domain.isInside(cell)) continue;
      const bool own = isIn(cell);
      const Vec3d out = normalAt(solid.phi->constTree(), cell), depth = -double(wall.getValue(cell)) * out;
      const double gap = source.distance(h * (cell.asVec3d() + Vec3d(0.5)) + depth);
      if (!own && gap >= kNearSolid * h && depth.length() <= kSliver * h) continue;
      const Vec3d along = source.speed - std::min(0.0, source.speed.dot(out)) * out;
      for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const bool up = side % 2 != 0;
        Coord face = cell, beside = cell;
        face[axis] += int(up);
        beside[axis] += up ? 1 : -1;
        if (solid.open[axis].constTree().getValue(face) <= 0.0f) continue;
        if (own) {
          given.set(axis, face, static_cast<float>(factor * speeds.at(cell, axis, up)));
        } else if (solid.domain.isInside(beside) && isIn(beside)) {
          const double speed = speeds.at(beside, axis, !up);
          if (up ? speed < 0.0 : speed > 0.0)
            given.set(axis, face, static_cast<float>(factor * between(along[axis], 0.0, speed)));
        }
      }
    }
  }
}

}  // namespace

bool isInSource(const SourceGrids& source, const SolidField& solid, const Coord& cell) {
  const float distance = source.phi->constTree().getValue(cell);
  if (distance < 0.0f) return true;
  const float h = static_cast<float>(solid.voxelSize), depth = -solid.phi->constTree().getValue(cell) / h;
  if (distance >= kFarthest * h || depth < 0.0f || depth >= kFarthest) return false;
  const Vec3d out = normalAt(solid.phi->constTree(), cell);
  if (out == Vec3d(0.0)) return false;
  // Along the solid's normal the open part reaches from the solid's surface to the end of the cell.
  const double end = 0.5 * (std::abs(out[0]) + std::abs(out[1]) + std::abs(out[2]));
  const Vec3d middle = cell.asVec3d() + Vec3d(0.5) + 0.5 * (depth + std::max(double(depth), end)) * out;
  return source.distance(solid.voxelSize * middle) < 0.0;
}

std::array<FloatGrid::Ptr, 3> sourceFaces(const FloatGrid& phi, const Vec3d& velocity,
                                          const CoordBBox& domain) {
  const auto shape = phi.getConstUnsafeAccessor();
  const auto isIn = [&](const Coord& cell) { return shape.getValue(cell) < 0.0f; };
  const FaceSpeeds speeds(velocity, domain, isIn);
  std::array<FloatGrid::Ptr, 3> faces;
  for (int axis = 0; axis < 3; ++axis) {
    FloatGrid::Ptr grid = FloatGrid::create(0.0f);
    grid->setTransform(faceTransform(phi.voxelSize()[0], axis));
    for (const Coord& origin : wetLeaves(phi, domain)) {
      float scratch[kLeafSize];
      const float* values = leafValues(phi.constTree(), origin, scratch);
      for (int c = 0; c < kLeafSize; ++c) {
        const Coord cell = origin.offsetBy(c >> 6, (c >> 3) & 7, c & 7);
        if (values[c] >= 0.0f || !domain.isInside(cell)) continue;
        Coord next = cell;
        next[axis] += 1;
        grid->tree().setValueOn(cell, speeds.at(cell, axis, false));
        grid->tree().setValueOn(next, speeds.at(cell, axis, true));
      }
    }
    faces[axis] = grid;
  }
  return faces;
}

void giveSource(GivenFaces& given, const SourceGrids& source, double factor, const SolidField& solid) {
  for (int axis = 0; axis < 3; ++axis) {
    // Where a solid stands in a source its surface holds the liquid, as elsewhere.
    const auto open = solid.open[axis].getConstAccessor();
    for (auto it = source.velocity[axis]->cbeginValueOn(); it; ++it)
      if (open.getValue(it.getCoord()) > 0.0f)
        given.set(axis, it.getCoord(), static_cast<float>(factor * *it));
  }
  giveSlivers(given, source, factor, solid);
}

}  // namespace fluidtex::sim
