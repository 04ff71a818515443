#include "sim/surface/cell_volume.h"

#include "sim/grid/leaf_patch.h"
#include "sim/solids/solid_layers.h"
#include "sim/surface/level_set.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

// Half a cell's diagonal: a solid this far from the centre, in cells, does not reach into the cell.
constexpr float kClear = 0.87f;

// The share of a cell on the inner side of two planes, each of which alone leaves a share a or b of it.
// cosine: of the angle between the outward normals. Exact where one plane lies behind the other, where they
// cross at a right angle and where they face each other, as the two sides of a film do; interpolated linearly
// between.
float shareWithin(float a, float b, float cosine) {
  const float same = std::min(a, b), opposite = std::max(0.0f, a + b - 1.0f);
  return a * b + (cosine > 0.0f ? cosine * (same - a * b) : cosine * (a * b - opposite));
}

// Cosine of the angle between the surface and a solid at a cell: 1 where both end the liquid on the same
// side, and where phi has no slope. Values deep in solids are extrapolated and do not count, nor does what is
// behind a thin wall. h: metres. visible: null where all is.
float cosineBetween(const LeafPatch& phi, const LeafPatch& solid, int at, float h,
                    const VisibleCells* visible) {
  const float deep = -kDeepInSolid * h;
  float dot = 0.0f, ofPhi = 0.0f, ofSolid = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const int stride = kPatchStride[axis], seen = VisibleCells::kStride[axis];
    const bool below = visible == nullptr || visible->sees(VisibleCells::kMiddle - seen),
               above = visible == nullptr || visible->sees(VisibleCells::kMiddle + seen);
    const int low = below && solid[at - stride] > deep ? at - stride : at,
              high = above && solid[at + stride] > deep ? at + stride : at;
    const bool both = low != at && high != at;
    const float p = (both ? 0.5f : 1.0f) * (phi[high] - phi[low]),
                s = (below && above ? 1.0f : 2.0f) *
                    (solid[below ? at - stride : at] - solid[above ? at + stride : at]);
    dot += p * s;
    ofPhi += p * p;
    ofSolid += s * s;
  }
  const float lengths = std::sqrt(ofPhi * ofSolid);
  return lengths > 1e-2f * h * h ? dot / lengths : 1.0f;
}

}  // namespace

void openShares(const SolidField& solid, const Coord& origin, LeafShares& open) {
  const float h = static_cast<float>(solid.voxelSize);
  float scratch[kLeafSize];
  const float* s = leafValues(solid.phi->constTree(), origin, scratch);
  bool anyNear = false;
  for (int i = 0; i < kLeafSize; ++i) {
    open[i] = std::clamp(0.5f + s[i] / h, 0.0f, 1.0f);
    anyNear = anyNear || s[i] < kClear * h;
  }
  if (!anyNear) return;
  std::array<LeafPatch, 3> faces;
  const auto& grids = solid.open.component;
  for (int a = 0; a < 3; ++a) faces[a] = patchOf(grids[a]->constTree(), origin);
  for (int i = 0; i < kLeafSize; ++i) {
    const int at = patchIndex(i);
    float any = 0.0f;
    for (int a = 0; a < 3; ++a) any += faces[a][at] + faces[a][at + kPatchStride[a]];
    if (any <= 0.0f) open[i] = 0.0f;
  }
}

void liquidShares(const FloatGrid& phi, const SolidField& solid, const Coord& origin, LeafShares& liquid,
                  Counts counts) {
  const float h = static_cast<float>(solid.voxelSize);
  openShares(solid, origin, liquid);
  const LeafPatch p = patchOf(phi.constTree(), origin), s = patchOf(solid.phi->constTree(), origin);
  const Visibility::Leaf* visibility = solid.visibility != nullptr ? solid.visibility->leaf(origin) : nullptr;
  // Whether a cell shows liquid beside the cell at an offset, on a side. Its centre may be in a solid, as
  // over a floor that is thinly covered, where it has an open part on this side of the solid.
  const auto isLiquidBeside = [&](int i, int side) {
    const int axis = side / 2, stride = kPatchStride[axis];
    const int at = side % 2 == 0 ? patchIndex(i) - stride : patchIndex(i) + stride;
    if (p[at] >= 0.0f) return false;
    if (s[at] > 0.0f) return true;
    if (s[at] <= -0.5f * h) return false;
    Coord face = origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
    if (side % 2 != 0) ++face[axis];
    return solid.open.component[axis]->constTree().getValue(face) > 0.0f;
  };
  for (int i = 0; i < kLeafSize; ++i) {
    const int at = patchIndex(i);
    if (p[at] >= 0.5f * h) {
      liquid[i] = 0.0f;
      continue;
    }
    const float wet = std::min(1.0f, 0.5f - p[at] / h);
    const VisibleCells* around =
        visibility != nullptr ? &(*visibility)[static_cast<std::size_t>(i)] : nullptr;
    liquid[i] = liquid[i] == 1.0f || liquid[i] == 0.0f || wet == 1.0f
                    ? std::min(liquid[i], wet)
                    : shareWithin(liquid[i], wet, cosineBetween(p, s, at, h, around));
    if (p[at] < 0.0f || liquid[i] == 0.0f || counts == Counts::unseen) continue;
    bool beside = false;
    for (int side = 0; side < 6 && !beside; ++side) beside = isLiquidBeside(i, side);
    if (!beside) liquid[i] = 0.0f;
  }
}

}  // namespace fluidtex::sim
