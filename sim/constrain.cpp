// Velocity that does not run into solids, where the pressure has had no say: Houston, Bond, Wiebe, "A unified
// approach for modeling complex occlusions in fluid simulations", 2003; Batty, Bertails, Bridson, 2007,
// section 4.4.
#include "sim/mac_grid.h"
#include "sim/solids.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<std::size_t>;
using FloatAccessor = openvdb::tree::ValueAccessor<const FloatTree>;
using MaskAccessor = openvdb::tree::ValueAccessor<const openvdb::MaskGrid::TreeType>;

Coord shifted(Coord c, int axis, int by) {
  c[axis] += by;
  return c;
}

// Component `other` at face (c, axis): the mean of the four faces around it.
float across(const FloatAccessor& other, const Coord& c, int axis, int otherAxis) {
  const Coord low = shifted(c, axis, -1);
  return 0.25f * (other.getValue(c) + other.getValue(shifted(c, otherAxis, 1)) + other.getValue(low) +
                  other.getValue(shifted(low, otherAxis, 1)));
}

// Whether a face lies beyond a side of the domain that is no wall.
bool beyondOpening(const SolidField& solid, const Coord& face, int axis) {
  for (int a = 0; a < 3; ++a) {
    const int last = solid.cells[a] - (a == axis ? 0 : 1);
    if (face[a] < 0 && solid.sides[2 * a] != Side::wall) return true;
    if (face[a] > last && solid.sides[2 * a + 1] != Side::wall) return true;
  }
  return false;
}

}  // namespace

void constrainToSolids(FloatGrid& u, FloatGrid& v, FloatGrid& w, const FloatGrid& phi,
                       const SolidField& solid, const FaceMasks& valid, const openvdb::MaskGrid& separating) {
  FloatGrid* const grids[3] = {&u, &v, &w};
  const FloatGrid* const open[3] = {solid.openU.get(), solid.openV.get(), solid.openW.get()};
  const openvdb::MaskGrid* const masks[3] = {valid.u.get(), valid.v.get(), valid.w.get()};

  const bool moving = solid.speedU != nullptr;
  const FloatGrid::Ptr atRest = FloatGrid::create(0.0f);
  const FloatGrid* const solidSpeed[3] = {moving ? solid.speedU.get() : atRest.get(),
                                          moving ? solid.speedV.get() : atRest.get(),
                                          moving ? solid.speedW.get() : atRest.get()};

  // All new values are found from the old ones before any is written.
  struct Change {
    FloatLeaf* leaf;
    int offset;
    float value;
  };
  std::vector<std::vector<Change>> changes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto leaves = leavesOf(grids[axis]->tree());
    const std::size_t first = changes.size();
    changes.resize(first + leaves.size());
    tbb::parallel_for(Range(0, leaves.size()), [&](const Range& range) {
      const FloatAccessor speed[3] = {FloatAccessor(u.constTree()), FloatAccessor(v.constTree()),
                                      FloatAccessor(w.constTree())};
      const FloatAccessor openness(open[axis]->constTree()), distance(solid.phi->constTree()),
          liquid(phi.constTree());
      const FloatAccessor push[3] = {FloatAccessor(solidSpeed[0]->constTree()),
                                     FloatAccessor(solidSpeed[1]->constTree()),
                                     FloatAccessor(solidSpeed[2]->constTree())};
      const MaskAccessor known(masks[axis]->constTree()), leaving(separating.constTree());
      for (std::size_t n = range.begin(); n < range.end(); ++n) {
        for (auto it = leaves[n]->beginValueOn(); it; ++it) {
          const Coord c = it.getCoord();
          if (openness.getValue(c) > 0.0f || known.isValueOn(c) || beyondOpening(solid, c, axis)) continue;
          const Coord low = shifted(c, axis, -1);
          openvdb::Vec3f normal(0.0f), velocity(0.0f);
          for (int a = 0; a < 3; ++a) {
            normal[a] = a == axis ? distance.getValue(c) - distance.getValue(low)
                                  : 0.25f * (distance.getValue(shifted(c, a, 1)) -
                                             distance.getValue(shifted(c, a, -1)) +
                                             distance.getValue(shifted(low, a, 1)) -
                                             distance.getValue(shifted(low, a, -1)));
            velocity[a] = a == axis ? *it : across(speed[a], c, axis, a);
            if (moving) velocity[a] -= a == axis ? push[a].getValue(c) : across(push[a], c, axis, a);
          }
          // Deep inside a solid the distance is cut off and there is no normal: nothing reads the velocity
          // there.
          const float length = normal.length();
          if (length < 0.5f * static_cast<float>(solid.voxelSize)) continue;
          normal /= length;
          const float outward = velocity.dot(normal);
          const bool wet = liquid.getValue(c) < 0.0f || liquid.getValue(low) < 0.0f;
          const bool free = !wet || leaving.isValueOn(c) || leaving.isValueOn(low);
          if (outward >= 0.0f && free) continue;
          changes[first + n].push_back({leaves[n], static_cast<int>(it.pos()), *it - outward * normal[axis]});
        }
      }
    });
  }
  tbb::parallel_for(Range(0, changes.size()), [&](const Range& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      for (const Change& change : changes[n]) change.leaf->setValueOnly(change.offset, change.value);
    }
  });
}

}  // namespace fluidtex::sim
