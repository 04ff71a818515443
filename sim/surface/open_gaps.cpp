#include "sim/surface/open_gaps.h"

#include "sim/grid/dilate.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/visibility.h"
#include "sim/surface/extend_into_solids.h"

namespace fluidtex::sim {
namespace {

// Whether a thin wall hides a cell from another.
bool hides(const SolidField& solid, const Coord& from, const Coord& cell) {
  return solid.visibility != nullptr && solid.visibility->hides(from, cell);
}

// Whether one of the 27 cells around and at this one is liquid outside solids, on its side of thin walls.
bool touchesLiquid(const FloatGrid& phi, const SolidField& solid, const Coord& cell) {
  const FloatGrid& solidPhi = *solid.phi;
  const float deep = -kDeepInSolid * static_cast<float>(solidPhi.voxelSize()[0]);
  for (int n = 0; n < 27; ++n) {
    const Coord at = cell.offsetBy(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
    if (phi.constTree().getValue(at) < 0.0f && solidPhi.constTree().getValue(at) >= deep &&
        !hides(solid, cell, at))
      return true;
  }
  return false;
}

// kLeaves: liquid separates from a solid, or closes on it, faster than this share of what gravity adds in a
// step. kStands: what moves by less than this share of a cell in a step is at rest.
constexpr double kLeaves = 0.05, kStands = 1e-3;

// Whether a film thinner than half a cell, held only by the wall's own cell, separates from the wall at this
// cell. It has no pressure of its own. It separates where the velocity points away from the solid, with
// `kick`, what gravity adds in a step, as under a ceiling; and where no liquid feeds it, except on floors,
// since nothing would move it any more.
bool leavesSolid(const FloatGrid& phi, const Velocity& velocity, const SolidField& solid, const Coord& cell,
                 const Vec3d& kick) {
  const FloatGrid& solidPhi = *solid.phi;
  const auto& push = solid.speed.component;
  const float deep = -kDeepInSolid * static_cast<float>(solidPhi.voxelSize()[0]);
  bool onFloor = false;
  // Liquid beside the film moves it along or, at rest, supports it.
  const bool touches = touchesLiquid(phi, solid, cell);
  const Vec3d fall = touches ? Vec3d(0.0) : kick;
  const double slowest = kLeaves * kick.length();
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, out = side % 2 == 0 ? 1 : -1;  // away from the solid on that side
    Coord beyond = cell, face = cell;
    beyond[axis] -= out;
    if (out < 0) face[axis] += 1;
    if (solidPhi.constTree().getValue(beyond) >= deep) continue;
    const bool outside = !solid.domain.isInside(beyond);
    if (outside && solid.sides[side] == Side::symmetry) continue;
    if (outside && !isClosed(solid.sides[side])) return true;  // nothing beyond counts
    double speed = velocity.component[axis]->constTree().getValue(face);
    if (push[axis] != nullptr) speed -= push[axis]->constTree().getValue(face);
    if (out * (speed + fall[axis]) > slowest) return true;
    onFloor = onFloor || out * kick[axis] < -0.5 * kick.length();
  }
  return !onFloor && !touches;
}

// Whether a cell of liquid moves or is driven against a solid beside it. kick: what gravity adds to its
// velocity in a step. Liquid at rest on a floor has the floor's velocity, whatever gap is left.
bool closesOn(const Velocity& velocity, const SolidField& solid, const Coord& cell, const Vec3d& kick,
              double slowest) {
  const auto& push = solid.speed.component;
  Vec3d normal(0.0), speed = kick;  // out of the solid; against it
  for (int axis = 0; axis < 3; ++axis) {
    Coord low = cell, high = cell;
    low[axis] -= 1;
    high[axis] += 1;
    normal[axis] = solid.phi->constTree().getValue(high) - solid.phi->constTree().getValue(low);
    for (const Coord& face : {cell, high}) {
      speed[axis] += 0.5 * velocity.component[axis]->constTree().getValue(face);
      if (push[axis] != nullptr) speed[axis] -= 0.5 * push[axis]->constTree().getValue(face);
    }
  }
  return -speed.dot(normal) > slowest * normal.length();
}

// Neighbours whose distances to a wall differ by no more than this share of a cell lie along it.
constexpr float kAlong = 0.25f;

}  // namespace

void openGaps(FloatGrid& phi, const Velocity& velocity, const SolidField& solid, const MaskGrid& separating,
              const Vec3d& kick, double dt) {
  if (!separating.empty()) {
    // The cut includes the neighbours of separating cells along the wall. Farther from it another wall may be
    // nearer, at which the liquid stays.
    MaskGrid around(separating);
    const auto distance = solid.phi->getConstAccessor();
    const float along = kAlong * static_cast<float>(solid.voxelSize);
    for (auto it = separating.cbeginValueOn(); it; ++it) {
      const float here = distance.getValue(it.getCoord());
      for (int side = 0; side < 6; ++side) {
        Coord beside = it.getCoord();
        beside[side / 2] += side % 2 == 0 ? -1 : 1;
        if (distance.getValue(beside) <= here + along && !hides(solid, it.getCoord(), beside))
          around.tree().setValueOn(beside);
      }
    }
    cutSolids(phi, *solid.phi, around);
    openvdb::tools::dilateActiveValues(around.tree(), 3, openvdb::tools::NN_FACE);
    for (auto leaf = around.constTree().cbeginLeaf(); leaf; ++leaf) phi.tree().touchLeaf(leaf->origin());
  }
  GapRules rules;
  rules.opens = [&](const Coord& cell) {
    return phi.constTree().getValue(cell) < 0.0f ? separating.constTree().isValueOn(cell)
                                                 : leavesSolid(phi, velocity, solid, cell, kick);
  };
  const double slowest = kLeaves * kick.length() + kStands * solid.voxelSize / dt;
  rules.closes = [&](const Coord& cell) { return closesOn(velocity, solid, cell, kick, slowest); };
  extendBeyond(phi, solid, rules);
  trimBand(phi, *solid.phi);
}

}  // namespace fluidtex::sim
