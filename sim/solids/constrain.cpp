// Velocity that does not enter solids, where the pressure has not determined it: Houston, Bond, Wiebe, "A
// unified approach for modeling complex occlusions in fluid simulations", 2003; Batty, Bertails, Bridson,
// 2007, section 4.4.
#include "sim/solids/constrain.h"

#include "sim/grid/leaf_block.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/solids/visibility.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<std::size_t>;
using MaskAccessor = openvdb::tree::ValueAccessor<const MaskGrid::TreeType>;

using Block = LeafBlock<1>;
constexpr auto& kBlockStride = Block::kStride;

// Component `other` at a face normal to `axis`: the mean of the four faces around it.
float across(const float* other, int axis, int otherAxis) {
  const float* low = other - kBlockStride[axis];
  return 0.25f * (other[0] + other[kBlockStride[otherAxis]] + low[0] + low[kBlockStride[otherAxis]]);
}

Coord shifted(Coord c, int axis, int by) {
  c[axis] += by;
  return c;
}

// Whether a face lies beyond a side of the domain that lets liquid pass.
bool beyondOpening(const SolidField& solid, const Coord& face, int axis) {
  for (int a = 0; a < 3; ++a) {
    const int last = solid.domain.max()[a] + (a == axis ? 1 : 0);
    if (face[a] < solid.domain.min()[a] && !isClosed(solid.sides[2 * a])) return true;
    if (face[a] > last && !isClosed(solid.sides[2 * a + 1])) return true;
  }
  return false;
}

// Whether a thin wall separates the two cells of a leaf's face. sight: null where all is visible.
bool isInThinWall(const Visibility::Leaf* sight, int offset, int axis) {
  return sight != nullptr && !(*sight)[offset].sees(VisibleCells::kMiddle - VisibleCells::kStride[axis]);
}

// The side of a face in a thin wall, 1 above and -1 below, that alone has liquid which leaves the wall; 0 for
// none: both sides read the face's velocity. phi: at the cell above it.
template <class Leaves>
int sideThatLeaves(const float* phi, int stride, const Leaves& leaves) {
  const bool above = phi[0] < 0.0f, below = phi[-stride] < 0.0f;
  if (above == below) return 0;
  const int side = above ? 1 : -1;
  return leaves(side) ? side : 0;
}

// A leaf's active faces that are closed, or almost closed, and not known.
FloatLeaf::NodeMaskType closedFaces(const FloatLeaf& leaf, const FloatTree& open, const MaskTree& known) {
  float scratch[kLeafSize];
  const float* openness = leafValues(open, leaf.origin(), scratch);
  FloatLeaf::NodeMaskType faces = leaf.getValueMask();
  if (const auto* there = known.probeConstLeaf(leaf.origin())) {
    faces -= there->getValueMask();
  } else if (known.isValueOn(leaf.origin())) {
    faces.setOff();
  }
  for (int i = 0; i < kLeafSize; ++i) {
    if (openness[i] >= kLeastOpen) faces.setOff(i);
  }
  return faces;
}

}  // namespace

void constrainToSolids(Velocity& velocity, const FloatGrid& phi, const SolidField& solid,
                       const FaceMasks& valid, const MaskGrid& separating) {
  const auto& grids = velocity.component;
  const auto& open = solid.open.component;
  const auto& masks = valid.component;

  const bool moving = bool(solid.speed), anyLeaving = !separating.empty();
  const auto& solidSpeed = solid.speed.component;

  // All new values are computed from the old ones before any is written.
  struct Change {
    float* value;
    float to;
  };
  const auto leaves = leavesOf(grids[0]->tree());
  std::vector<std::vector<Change>> changes(leaves.size());
  tbb::parallel_for(Range(0, leaves.size()), [&](const Range& range) {
    const MaskAccessor leaving(separating.constTree());
    const openvdb::tree::ValueAccessor<const FloatTree> wall(solid.phi->constTree());
    Block distance, liquid, speed[3], push[3];
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const Coord origin = leaves[n]->origin();
      std::array<FloatLeaf*, 3> own;
      std::array<FloatLeaf::NodeMaskType, 3> asked;
      bool any = false;
      for (int axis = 0; axis < 3; ++axis) {
        own[axis] = axis == 0 ? leaves[n] : grids[axis]->tree().probeLeaf(origin);
        if (own[axis] == nullptr) continue;
        asked[axis] = closedFaces(*own[axis], open[axis]->constTree(), masks[axis]->constTree());
        any = any || !asked[axis].isOff();
      }
      if (!any) continue;
      distance.load(solid.phi->constTree(), origin);
      // Deep inside a solid the distance is clamped and has no gradient.
      const auto [least, most] = std::minmax_element(distance.begin(), distance.end());
      if (*most - *least < 1e-3f * static_cast<float>(solid.voxelSize)) continue;
      const Visibility::Leaf* sight = solid.visibility != nullptr ? solid.visibility->leaf(origin) : nullptr;
      liquid.load(phi.constTree(), origin);
      for (int a = 0; a < 3; ++a) {
        speed[a].load(grids[a]->constTree(), origin);
        if (moving) push[a].load(solidSpeed[a]->constTree(), origin);
      }
      for (int axis = 0; axis < 3; ++axis) {
        for (auto it = asked[axis].beginOn(); it; ++it) {
          const int offset = static_cast<int>(it.pos()), at = Block::index(offset);
          const Coord c = origin + Coord(offset >> 6, (offset >> 3) & 7, offset & 7);
          if (beyondOpening(solid, c, axis)) continue;
          const float *here = distance.data() + at, *below = here - kBlockStride[axis];
          openvdb::Vec3f normal(0.0f), velocity(0.0f);
          for (int a = 0; a < 3; ++a) {
            normal[a] = a == axis ? here[0] - below[0]
                                  : 0.25f * (here[kBlockStride[a]] - here[-kBlockStride[a]] +
                                             below[kBlockStride[a]] - below[-kBlockStride[a]]);
            velocity[a] = a == axis ? speed[a][at] : across(speed[a].data() + at, axis, a);
            if (moving) velocity[a] -= a == axis ? push[a][at] : across(push[a].data() + at, axis, a);
          }
          // In the middle of a thin wall both sides read the velocity. Deep inside a solid there is no
          // normal, and nothing reads it.
          const bool within = *here < 0.0f && *below < 0.0f && here[kBlockStride[axis]] > *here;
          if (isInThinWall(sight, offset, axis) || (within && wall.getValue(shifted(c, axis, -2)) > *below)) {
            const int side = sideThatLeaves(liquid.data() + at, kBlockStride[axis], [&](int from) {
              return leaving.isValueOn(from > 0 ? c : shifted(c, axis, -1));
            });
            const float still = speed[axis][at] - velocity[axis];
            const float there = side == 0 ? still : speed[axis][at + side * kBlockStride[axis]];
            changes[n].push_back({own[axis]->buffer().data() + offset,
                                  side > 0 ? std::max(still, there) : std::min(still, there)});
            continue;
          }
          const float length = normal.length();
          if (length < 0.5f * static_cast<float>(solid.voxelSize)) continue;
          normal /= length;
          const float outward = velocity.dot(normal);
          if (outward >= 0.0f) {
            const bool wet = liquid[at] < 0.0f || liquid[at - kBlockStride[axis]] < 0.0f;
            if (!wet || (anyLeaving && (leaving.isValueOn(c) || leaving.isValueOn(shifted(c, axis, -1)))))
              continue;
          }
          changes[n].push_back(
              {own[axis]->buffer().data() + offset, speed[axis][at] - outward * normal[axis]});
        }
      }
    }
  });
  tbb::parallel_for(Range(0, changes.size()), [&](const Range& range) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      for (const Change& change : changes[n]) *change.value = change.to;
    }
  });
}

}  // namespace fluidtex::sim
