#include "sim/surface/curvature.h"

#include "sim/grid/leaf_block.h"
#include "sim/grid/normal.h"
#include "sim/grid/trilinear.h"
#include "sim/surface/surface_distance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace fluidtex::sim {
namespace {

using CurvatureBlock = LeafBlock<1>;

// Depth in solids, in cells, that deeper cells are taken to have; mirror images then lie within kWideHalo of
// a leaf.
constexpr float kDeepest = 1.5f;
constexpr int kWideHalo = 4, kWideSide = kLeafDim + 2 * kWideHalo;
constexpr int kSolidHalo = 2, kSolidSide = kLeafDim + 2 * kSolidHalo;

// Largest curvature, in units of 1/h: that of a drop of two cells' radius.
constexpr double kMost = 1.0;

// Weights of a value and of its two neighbours.
constexpr double kBeside[3] = {0.25, 0.5, 0.25};

struct Bend {
  double curvature = 0.0;  // 1/h
  bool smooth = false;
};

// phi / h is given around p. Differences are averaged over the 3 x 3 parallel lines. Without that, capillary
// waves of the grid's wavelength that run oblique to it have the largest curvature where they are resolved
// worst, and drops shiver.
Bend bendAt(const float* p) {
  double slope[3] = {}, second[3] = {}, mixed[3] = {};  // mixed: yz, xz, xy
  for (int a = 0; a < 3; ++a) {
    const int d = CurvatureBlock::kStride[a], e = CurvatureBlock::kStride[(a + 1) % 3],
              f = CurvatureBlock::kStride[(a + 2) % 3];
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const float* q = p + i * e + j * f;
        const double weight = kBeside[i + 1] * kBeside[j + 1];
        slope[a] += 0.5 * weight * (double(q[d]) - q[-d]);
        second[a] += weight * (double(q[d]) - 2.0 * q[0] + q[-d]);
      }
      const float* q = p + i * d;
      mixed[a] += 0.25 * kBeside[i + 1] * (double(q[e + f]) - q[e - f] - q[f - e] + q[-e - f]);
    }
  }
  const double square = slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
  if (!(square > 1e-6)) return {};
  const double length = std::sqrt(square);
  double along = 0.0, gauss = 0.0, largest = 0.0;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    along += slope[a] * slope[a] * second[a] + 2.0 * slope[b] * slope[c] * mixed[a];
    gauss += slope[a] * slope[a] * (second[b] * second[c] - mixed[a] * mixed[a]) +
             2.0 * slope[b] * slope[c] * (mixed[b] * mixed[c] - second[a] * mixed[a]);
    largest = std::max(largest, std::abs(second[a]));
  }
  const double sum = (square * (second[0] + second[1] + second[2]) - along) / (square * length);
  gauss /= square * square;
  // From the level set through this cell, a parallel surface, to phi = 0.
  const double depth = std::clamp<double>(p[0], -1.0, 1.0);
  const double shrink = 1.0 - depth * sum + depth * depth * gauss;
  const double atSurface = shrink > 0.25 ? (sum - 2.0 * depth * gauss) / shrink : sum;
  return {std::clamp(atSurface, -kMost, kMost), largest < kSharpSlope * length};
}

bool besideSurface(const float* p) {
  const bool inside = p[0] < 0.0f;
  return std::any_of(CurvatureBlock::kStride, CurvatureBlock::kStride + 3,
                     [&](int d) { return (p[d] < 0.0f) != inside || (p[-d] < 0.0f) != inside; });
}

// Whether the solid's normal leads from a cell in it to a wall's other side, as it can in the corner of thin
// walls, between their middles. depth: cells.
bool leadsThrough(const Visibility& visibility, const Coord& cell, const float (&normal)[3], float depth) {
  Coord outside = cell;
  for (int a = 0; a < 3; ++a) outside[a] += static_cast<int>(std::lround((depth + 0.5f) * normal[a]));
  return visibility.hides(cell, outside);
}

// Sets cells in solids to the values of phi at their mirror images across the solid's surface. block: phi
// around a leaf, as wide as a CurvatureBlock.
void mirrorInSolids(const FloatGrid& phi, const FloatGrid& solidPhi, const Visibility* visibility,
                    const Coord& origin, float* block) {
  float solid[kSolidSide * kSolidSide * kSolidSide], wide[kWideSide * kWideSide * kWideSide];
  gather(solidPhi.constTree(), origin, kSolidHalo, solid);
  if (std::none_of(std::begin(solid), std::end(solid), [](float s) { return s < 0.0f; })) return;
  gather(phi.constTree(), origin, kWideHalo, wide);
  constexpr int kStep[3] = {kSolidSide * kSolidSide, kSolidSide, 1};
  const auto h = static_cast<float>(phi.voxelSize()[0]);
  for (int n = 0; n < CurvatureBlock::kSide * CurvatureBlock::kSide * CurvatureBlock::kSide; ++n) {
    const int cell[3] = {n / CurvatureBlock::kStride[0],
                         n / CurvatureBlock::kStride[1] % CurvatureBlock::kSide, n % CurvatureBlock::kSide};
    const float* s = solid + (cell[0] + 1) * kStep[0] + (cell[1] + 1) * kStep[1] + (cell[2] + 1);
    if (*s >= 0.0f) continue;
    float normal[3];
    for (int a = 0; a < 3; ++a) normal[a] = 0.5f * (s[kStep[a]] - s[-kStep[a]]);
    const float length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    // Deep in solids the distance is clamped and has no gradient.
    if (length < 0.5f * h) continue;
    for (float& part : normal) part /= length;
    const float depth = std::min(-*s / h, kDeepest);
    const Coord place = origin.offsetBy(cell[0] - CurvatureBlock::kHalo, cell[1] - CurvatureBlock::kHalo,
                                        cell[2] - CurvatureBlock::kHalo);
    if (visibility != nullptr && leadsThrough(*visibility, place, normal, depth)) continue;
    int low[3];
    float part[3];
    for (int a = 0; a < 3; ++a) {
      const float at =
          static_cast<float>(cell[a] - CurvatureBlock::kHalo + kWideHalo) + 2.0f * depth * normal[a];
      low[a] = std::clamp(static_cast<int>(std::floor(at)), 0, kWideSide - 2);
      part[a] = std::clamp(at - static_cast<float>(low[a]), 0.0f, 1.0f);
    }
    block[n] = trilinear(wide + (low[0] * kWideSide + low[1]) * kWideSide + low[2], kWideSide * kWideSide,
                         kWideSide, part[0], part[1], part[2]);
  }
}

// The 27 values around `at` of a block on the cell's own side: values behind a thin wall are mirrored at the
// wall's plane, which lies `wall` cells away along `normal`, both measured from the cell. Written into
// `seen`, at the same place.
void mirrorUnseen(const float* block, int at, const VisibleCells& visible, double wall, const Vec3d& normal,
                  float* seen) {
  for (int n = 0; n < 27; ++n) {
    const int i = n / 9 - 1, j = n / 3 % 3 - 1, k = n % 3 - 1;
    const int offset =
        i * CurvatureBlock::kStride[0] + j * CurvatureBlock::kStride[1] + k * CurvatureBlock::kStride[2];
    const int bit = VisibleCells::kMiddle + i * VisibleCells::kStride[0] + j * VisibleCells::kStride[1] +
                    k * VisibleCells::kStride[2];
    if (visible.sees(bit)) {
      seen[at + offset] = block[at + offset];
      continue;
    }
    const Vec3d way(i, j, k);
    const Vec3d image = way - 2.0 * std::min(0.0, wall + normal.dot(way)) * normal;
    int low[3];
    double part[3];
    for (int a = 0; a < 3; ++a) {
      low[a] = image[a] < 0.0 ? -1 : 0;
      part[a] = std::clamp(image[a] - low[a], 0.0, 1.0);
    }
    // Only the visible cells of the cube around the image count.
    double sum = 0.0, weights = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      int to = at, seenAt = VisibleCells::kMiddle;
      for (int a = 0; a < 3; ++a) {
        const int up = corner >> a & 1;
        weight *= up != 0 ? part[a] : 1.0 - part[a];
        to += (low[a] + up) * CurvatureBlock::kStride[a];
        seenAt += (low[a] + up) * VisibleCells::kStride[a];
      }
      if (!visible.sees(seenAt)) continue;
      sum += weight * block[to];
      weights += weight;
    }
    seen[at + offset] = weights > 0.0 ? static_cast<float>(sum / weights) : block[at];
  }
}

}  // namespace

FloatGrid::Ptr surfaceCurvature(const FloatGrid& phi, const FloatGrid& solidPhi,
                                const Visibility* visibility) {
  const auto h = static_cast<float>(phi.voxelSize()[0]);
  const auto leaves = leavesOf(phi.constTree());
  std::vector<std::unique_ptr<FloatLeaf>> made(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    static thread_local float block[CurvatureBlock::kCount], seen[CurvatureBlock::kCount];
    const Coord origin = leaves[n]->origin();
    gather(phi.constTree(), origin, CurvatureBlock::kHalo, block);
    const auto [low, high] = std::minmax_element(std::begin(block), std::end(block));
    if (!(*low < 0.0f) || *high < 0.0f) return;
    mirrorInSolids(phi, solidPhi, visibility, origin, block);
    for (float& value : block) value /= h;
    for (int c = 0; c < kLeafSize; ++c) {
      const int at = CurvatureBlock::index(c);
      const Coord cell = leaves[n]->offsetToGlobalCoord(static_cast<openvdb::Index>(c));
      const VisibleCells* visible = visibility != nullptr ? visibility->around(cell) : nullptr;
      const float* values = block;
      if (visible != nullptr) {
        mirrorUnseen(block, at, *visible, solidPhi.tree().getValue(cell) / h, normalAt(solidPhi.tree(), cell),
                     seen);
        values = seen;
      }
      if (!besideSurface(values + at)) continue;
      if (!made[n]) made[n] = std::make_unique<FloatLeaf>(origin, 0.0f, false);
      const Bend bend = bendAt(values + at);
      made[n]->setValueOnly(c, static_cast<float>(bend.curvature / h));
      made[n]->setActiveState(c, bend.smooth || solidPhi.tree().getValue(cell) < h);
    }
  });
  FloatGrid::Ptr curvature = FloatGrid::create(0.0f);
  curvature->setTransform(phi.transform().copy());
  for (auto& leaf : made)
    if (leaf) curvature->tree().addLeaf(leaf.release());
  return curvature;
}

}  // namespace fluidtex::sim
