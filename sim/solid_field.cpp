// Open areas by marching squares on nodal distances: Ng, Min, Gibou, "An efficient fluid-solid coupling
// algorithm for single-phase flows", 2009, section 3; Min and Gibou, "Geometric integration over irregular
// domains", 2007.
#include "sim/solid_field.h"

#include "sim/mac_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<int>;

constexpr int kMargin = 8;  // cells outside the domain where solid.phi is right
constexpr int kNodes = kLeafDim + 1;

// Open shares below this count as closed: they would let next to nothing through and spoil the matrix.
constexpr double kClosed = 1e-3;

// Distances below this share of a cell are 0, so that a wall in the plane of a face closes it in spite of
// rounding.
constexpr double kOnWall = 1e-6;

// Area of the part of the unit square where the distance is positive; corners in order, no saddle.
double polygonArea(const std::array<double, 4>& d) {
  static constexpr double kX[4] = {0, 1, 1, 0}, kY[4] = {0, 0, 1, 1};
  double x[8], y[8];
  int n = 0;
  for (int a = 0; a < 4; ++a) {
    const int b = (a + 1) & 3;
    if (d[a] > 0.0) {
      x[n] = kX[a];
      y[n++] = kY[a];
    }
    if ((d[a] > 0.0) != (d[b] > 0.0)) {
      const double t = d[a] / (d[a] - d[b]);
      x[n] = kX[a] + t * (kX[b] - kX[a]);
      y[n++] = kY[a] + t * (kY[b] - kY[a]);
    }
  }
  double twice = 0.0;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    twice += x[i] * y[j] - x[j] * y[i];
  }
  return 0.5 * twice;
}

// Corner triangle of a saddle: corner a alone has its sign.
double cornerArea(double corner, double next, double previous) {
  return 0.5 * corner / (corner - next) * corner / (corner - previous);
}

double snapped(double fraction) {
  if (fraction < kClosed) return 0.0;
  return fraction > 1.0 - kOnWall ? 1.0 : fraction;
}

enum class Fill { closed, open, cut };

struct Block {
  Coord origin;
  Fill fill = Fill::closed;
  std::array<std::array<float, kLeafSize>, 3> faces;
};

// Open shares of the lower faces of the block's cells, from distances at its 9^3 nodes.
void computeFaces(const SolidDistance& distance, const Coord& cells, double h, Block& block) {
  std::vector<double> node(kNodes * kNodes * kNodes);
  for (int i = 0, n = 0; i < kNodes; ++i) {
    for (int j = 0; j < kNodes; ++j) {
      for (int k = 0; k < kNodes; ++k, ++n) {
        const Coord at = block.origin.offsetBy(i, j, k);
        const double d = distance(Vec3d(at[0] * h, at[1] * h, at[2] * h));
        node[n] = std::abs(d) < kOnWall * h ? 0.0 : d;
      }
    }
  }
  constexpr int kStep[3] = {kNodes * kNodes, kNodes, 1};
  for (int c = 0; c < kLeafSize; ++c) {
    const Coord local(c >> 6, (c >> 3) & 7, c & 7);
    const double* d = node.data() + local[0] * kStep[0] + local[1] * kStep[1] + local[2] * kStep[2];
    for (int axis = 0; axis < 3; ++axis) {
      const int s = kStep[(axis + 1) % 3], t = kStep[(axis + 2) % 3];
      const Coord at = block.origin + local;
      const int beside = (axis + 1) % 3, along = (axis + 2) % 3;
      const bool inside = at[axis] <= cells[axis] && at[beside] < cells[beside] && at[along] < cells[along];
      block.faces[axis][c] = inside ? static_cast<float>(openAreaFraction(d[0], d[s], d[s + t], d[t])) : 0.0f;
    }
  }
}

FloatGrid::Ptr cellDistances(const SolidDistance& distance, const Coord& cells, double h) {
  const float band = static_cast<float>(kSolidBand * h);
  FloatGrid::Ptr grid = makePhi(h, band);
  grid->setName("solidPhi");
  const Coord n((cells[0] + 2 * kMargin + 7) >> 3, (cells[1] + 2 * kMargin + 7) >> 3,
                (cells[2] + 2 * kMargin + 7) >> 3);
  const int count = n[0] * n[1] * n[2];
  // Farther than this from the block's middle, no cell of the block is in the band.
  const double radius = (0.5 * std::sqrt(3.0) * (kLeafDim - 1) + kSolidBand) * h;
  std::vector<std::unique_ptr<FloatLeaf>> leaves(count);
  std::vector<char> solid(count, 0);
  const auto originOf = [&](int b) {
    return (Coord(b / (n[1] * n[2]), b / n[2] % n[1], b % n[2]) << 3).offsetBy(-kMargin);
  };
  tbb::parallel_for(Range(0, count), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const Coord origin = originOf(b);
      const double middle = distance(Vec3d((origin[0] + 4) * h, (origin[1] + 4) * h, (origin[2] + 4) * h));
      if (std::abs(middle) > radius) {
        solid[b] = middle < 0.0;
        continue;
      }
      leaves[b] = std::make_unique<FloatLeaf>(origin, band, false);
      for (int c = 0; c < kLeafSize; ++c) {
        const Coord at = leaves[b]->offsetToGlobalCoord(c);
        const double d = distance(Vec3d((at[0] + 0.5) * h, (at[1] + 0.5) * h, (at[2] + 0.5) * h));
        leaves[b]->setValueOnly(c, std::clamp(static_cast<float>(d), -band, band));
        if (std::abs(d) < band) leaves[b]->setActiveState(c, true);
      }
    }
  });
  for (int b = 0; b < count; ++b) {
    if (leaves[b] != nullptr) {
      grid->tree().addLeaf(leaves[b].release());
    } else if (solid[b]) {
      grid->tree().addTile(1, originOf(b), -band, false);
    }
  }
  return grid;
}

}  // namespace

SolidField makeSolidField(const SolidDistance& distance, const SolidDistance& openDistance,
                          const Coord& cells, double h) {
  SolidField field;
  field.voxelSize = h;
  field.cells = cells;
  field.phi = cellDistances(distance, cells, h);

  const Coord n((cells[0] + 8) >> 3, (cells[1] + 8) >> 3, (cells[2] + 8) >> 3);  // room for the last faces
  const int count = n[0] * n[1] * n[2];
  std::vector<std::unique_ptr<Block>> blocks(count);
  const double radius = 0.5 * std::sqrt(3.0) * kLeafDim * h;
  tbb::parallel_for(Range(0, count), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const Coord origin = Coord(b / (n[1] * n[2]), b / n[2] % n[1], b % n[2]) << 3;
      const double middle =
          openDistance(Vec3d((origin[0] + 4) * h, (origin[1] + 4) * h, (origin[2] + 4) * h));
      if (middle < -radius) continue;
      blocks[b] = std::make_unique<Block>();
      blocks[b]->origin = origin;
      // Only the faces of the domain's own cells are open, also where a side is no wall.
      bool inside = true;
      for (int a = 0; a < 3; ++a) inside = inside && origin[a] + kLeafDim <= cells[a];
      blocks[b]->fill = middle > radius && inside ? Fill::open : Fill::cut;
      if (blocks[b]->fill == Fill::cut) computeFaces(openDistance, cells, h, *blocks[b]);
    }
  });
  FloatGrid::Ptr* const grids[3] = {&field.openU, &field.openV, &field.openW};
  static constexpr const char* kNames[3] = {"openU", "openV", "openW"};
  for (int axis = 0; axis < 3; ++axis) {
    FloatGrid::Ptr grid = FloatGrid::create(0.0f);
    grid->setTransform(faceTransform(h, axis));
    grid->setName(kNames[axis]);
    for (const auto& block : blocks) {
      if (block == nullptr) continue;
      if (block->fill == Fill::open) {
        grid->tree().addTile(1, block->origin, 1.0f, true);
        continue;
      }
      FloatLeaf* leaf = grid->tree().touchLeaf(block->origin);
      for (int c = 0; c < kLeafSize; ++c) {
        if (block->faces[axis][c] > 0.0f) leaf->setValueOn(c, block->faces[axis][c]);
      }
    }
    grid->tree().prune();
    *grids[axis] = grid;
  }
  return field;
}

double openAreaFraction(double d00, double d10, double d11, double d01) {
  const std::array<double, 4> d{d00, d10, d11, d01};
  const int positive = (d00 > 0.0) + (d10 > 0.0) + (d11 > 0.0) + (d01 > 0.0);
  if (positive == 0) return 0.0;
  if (std::min({d00, d10, d11, d01}) >= 0.0) return 1.0;
  const bool saddle = positive == 2 && (d00 > 0.0) == (d11 > 0.0);
  if (!saddle) return snapped(polygonArea(d));
  // The middle decides whether the two equal corners are joined.
  const bool joined = d00 + d10 + d11 + d01 > 0.0;
  double corners = 0.0;
  for (int a = 0; a < 4; ++a) {
    if ((d[a] > 0.0) != joined) corners += cornerArea(d[a], d[(a + 1) & 3], d[(a + 3) & 3]);
  }
  return snapped(joined ? 1.0 - corners : corners);
}

}  // namespace fluidtex::sim
