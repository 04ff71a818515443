#include "texture/levelset/level_set.h"

#include "numerics/catmull_rom.h"
#include "numerics/lanes.h"
#include "texture/levelset/crossed_cells.h"
#include "texture/loops/morton.h"
#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"

#include <openvdb/tree/ValueAccessor.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr std::size_t kBlockValues = std::size_t(kBlockPadded) * kBlockPadded * kBlockPadded;
static_assert(Leaf::DIM == kBlockSide);

// Values farther from the surface carry no information; the bound keeps products finite.
constexpr float kFarthest = 8.0f;

std::uint64_t morton(const Coord& origin) {
  return mortonCode(origin.x() / kBlockSide, origin.y() / kBlockSide, origin.z() / kBlockSide);
}

void requireFinite(const FloatGrid& phi, const std::vector<const Leaf*>& leaves) {
  const auto fail = [] { throw std::invalid_argument("the level set holds a value that is not finite"); };
  if (!std::isfinite(phi.background())) fail();
  auto tile = phi.cbeginValueAll();
  tile.setMaxDepth(FloatGrid::TreeType::DEPTH - 2);
  for (; tile; ++tile) {
    if (!std::isfinite(*tile)) fail();
  }
  std::vector<std::uint8_t> bad(leaves.size(), 0);
  tbb::parallel_for(std::size_t(0), leaves.size(), [&](std::size_t i) {
    const float* v = leaves[i]->buffer().data();
    float sum = 0.0f;  // x * 0 is 0 unless x is infinite or not a number
    for (std::size_t k = 0; k < Leaf::SIZE; ++k) sum += v[k] * 0.0f;
    bad[i] = !(sum == 0.0f);
  });
  if (std::find(bad.begin(), bad.end(), 1) != bad.end()) fail();
}

// Blocks that may have a cell with corners of both signs. A cell belongs to the block of its lowest corner,
// so the blocks below each leaf count too. Tiles of opposite sign may touch without a leaf between them:
// their rim counts as well.
std::vector<Coord> candidateBlocks(const FloatGrid& phi, const std::vector<const Leaf*>& leaves) {
  std::vector<Coord> blocks = gathered<Coord>(leaves.size(), [&](std::uint32_t i, std::vector<Coord>& found) {
    const Coord o = leaves[i]->origin();
    for (int n = 0; n < 8; ++n) {
      const Coord b = o.offsetBy(n & 1 ? -kBlockSide : 0, n & 2 ? -kBlockSide : 0, n & 4 ? -kBlockSide : 0);
      if (n == 0 || !phi.tree().probeConstLeaf(b)) found.push_back(b);
    }
  });
  auto acc = phi.getConstAccessor();
  const auto rim = [&](const Coord& o) {
    for (int n = 0; n < 27; ++n) {
      const Coord b =
          o.offsetBy((n % 3 - 1) * kBlockSide, (n / 3 % 3 - 1) * kBlockSide, (n / 9 - 1) * kBlockSide);
      if (acc.probeConstLeaf(b) || acc.getValue(b) < 0.0f) continue;
      for (int k = 0; k < 8; ++k) {
        blocks.push_back(
            o.offsetBy(k & 1 ? -kBlockSide : 0, k & 2 ? -kBlockSide : 0, k & 4 ? -kBlockSide : 0));
      }
      return;
    }
  };
  auto tile = phi.cbeginValueAll();
  tile.setMaxDepth(FloatGrid::TreeType::DEPTH - 2);
  for (; tile; ++tile) {
    if (*tile >= 0.0f) continue;
    const openvdb::CoordBBox box = tile.getBoundingBox();
    for (int x = box.min().x(); x < box.max().x(); x += kBlockSide) {
      const bool xRim = x == box.min().x() || x + kBlockSide > box.max().x();
      for (int y = box.min().y(); y < box.max().y(); y += kBlockSide) {
        const bool xyRim = xRim || y == box.min().y() || y + kBlockSide > box.max().y();
        const int last = box.max().z() + 1 - kBlockSide;
        const int step = xyRim || last == box.min().z() ? kBlockSide : last - box.min().z();
        for (int z = box.min().z(); z <= last; z += step) rim(Coord(x, y, z));
      }
    }
  }
  return blocks;
}

// Whether a cell of the block may have corners of both signs: not if the block and those above it have one
// sign.
bool maybeCrossed(const FloatGrid::ConstAccessor& acc, const Coord& origin) {
  bool inside = false, outside = false;
  for (int n = 0; n < 8; ++n) {
    const Coord o = origin.offsetBy(n & 1 ? kBlockSide : 0, n & 2 ? kBlockSide : 0, n & 4 ? kBlockSide : 0);
    const Leaf* leaf = acc.probeConstLeaf(o);
    if (!leaf) {
      (acc.getValue(o) < 0.0f ? inside : outside) = true;
    } else {
      // Of the blocks above, only the lowest layer, edge or corner belongs to the block.
      const float* v = leaf->buffer().data();
      const int xs = n & 1 ? 1 : kBlockSide, ys = n & 2 ? 1 : kBlockSide, zs = n & 4 ? 1 : kBlockSide;
      for (int x = 0; x < xs; ++x)
        for (int y = 0; y < ys; ++y) {
          const unsigned below = below8(load8(v + x * 64 + y * 8), 0.0f) & ((1u << zs) - 1u);
          inside = inside || below != 0;
          outside = outside || below != (1u << zs) - 1u;
        }
    }
    if (inside && outside) return true;
  }
  return false;
}

// The 11^3 values around a block, in voxels.
void gather(const FloatGrid::ConstAccessor& acc, const Coord& origin, float scale, float* out) {
  const Leaf* leaf[3][3][3];
  float tile[3][3][3];
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      for (int c = 0; c < 3; ++c) {
        const Coord o = origin.offsetBy((a - 1) * kBlockSide, (b - 1) * kBlockSide, (c - 1) * kBlockSide);
        leaf[a][b][c] = acc.probeConstLeaf(o);
        tile[a][b][c] = leaf[a][b][c] ? 0.0f : acc.getValue(o);
      }
    }
  }
  const auto clamped = [scale](float v) { return std::clamp(v * scale, -kFarthest, kFarthest); };
  const auto part = [](int x) { return x < 0 ? 0 : x < kBlockSide ? 1 : 2; };
  for (int x = -1; x <= 9; ++x) {
    for (int y = -1; y <= 9; ++y) {
      const auto& rowLeaf = leaf[part(x)][part(y)];
      const auto& rowTile = tile[part(x)][part(y)];
      const int row = (x & 7) * 64 + (y & 7) * 8;
      *out++ = clamped(rowLeaf[0] ? rowLeaf[0]->buffer().data()[row + 7] : rowTile[0]);
      if (rowLeaf[1]) {
        const float* v = rowLeaf[1]->buffer().data() + row;
        for (int z = 0; z < kBlockSide; ++z) *out++ = clamped(v[z]);
      } else {
        for (int z = 0; z < kBlockSide; ++z) *out++ = clamped(rowTile[1]);
      }
      for (int z = 0; z < 2; ++z)
        *out++ = clamped(rowLeaf[2] ? rowLeaf[2]->buffer().data()[row + z] : rowTile[2]);
    }
  }
}

struct CellBox {  // of crossed cells; empty if lo > hi
  std::array<std::int8_t, 3> lo{8, 8, 8}, hi{-1, -1, -1};
  bool empty() const { return hi[0] < 0; }
};

CellBox crossedCells(const float* values) {
  CellBox box;
  forCrossedCells(values, [&](int x, int y, int z, const float*) {
    const std::array<std::int8_t, 3> cell{std::int8_t(x), std::int8_t(y), std::int8_t(z)};
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], cell[k]);
      box.hi[k] = std::max(box.hi[k], cell[k]);
    }
  });
  return box;
}

void sortAlongCurve(std::vector<Coord>& blocks) {
  std::vector<std::pair<std::uint64_t, Coord>> keyed;
  keyed.resize(blocks.size());
  forEachIndex(blocks.size(), [&](std::uint32_t b) { keyed[b] = {morton(blocks[b]), blocks[b]}; });
  tbb::parallel_sort(keyed.begin(), keyed.end());
  keyed.erase(std::unique(keyed.begin(), keyed.end()), keyed.end());
  blocks.clear();
  for (const auto& [key, b] : keyed) blocks.push_back(b);
}

}  // namespace

LevelSet::LevelSet(const FloatGrid& phi) {
  if (!phi.hasUniformVoxels()) throw std::invalid_argument("the level set's voxels are not cubes");
  const double voxel = phi.voxelSize().x();
  if (!(voxel > 0.0) || !std::isfinite(voxel)) throw std::invalid_argument("the level set has no voxel size");
  const float scale = float(1.0 / voxel);

  std::vector<const Leaf*> leaves;
  phi.tree().getNodes(leaves);
  requireFinite(phi, leaves);
  std::vector<Coord> candidates = candidateBlocks(phi, leaves);
  sortAlongCurve(candidates);

  std::vector<CellBox> boxes(candidates.size());
  const auto forBlocks = [&](std::size_t count, const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const auto& range) {
      const FloatGrid::ConstAccessor acc = phi.getConstAccessor();
      for (std::size_t i = range.begin(); i < range.end(); ++i) body(acc, i);
    });
  };
  forBlocks(candidates.size(), [&](const FloatGrid::ConstAccessor& acc, std::size_t i) {
    if (!maybeCrossed(acc, candidates[i])) return;
    std::array<float, kBlockValues> v;
    gather(acc, candidates[i], scale, v.data());
    boxes[i] = crossedCells(v.data());
  });

  // A point that slides along the surface may leave its cell slightly: keep blocks within one cell.
  std::vector<Coord> around;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (boxes[i].empty()) continue;
    m_origins.push_back(candidates[i]);
    for (int n = 0; n < 27; ++n) {
      const std::array<int, 3> step{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      bool near = n != 13;
      for (std::size_t k = 0; k < 3; ++k) {
        near =
            near && !(step[k] < 0 && boxes[i].lo[k] > 0) && !(step[k] > 0 && boxes[i].hi[k] < kBlockSide - 1);
      }
      if (near)
        around.push_back(
            candidates[i].offsetBy(step[0] * kBlockSide, step[1] * kBlockSide, step[2] * kBlockSide));
    }
  }
  m_surfaceBlocks = m_origins.size();
  sortAlongCurve(around);

  m_blocks = BlockTable(m_surfaceBlocks + around.size());
  for (const Coord& origin : m_origins) m_blocks.enter(origin);
  for (const Coord& origin : around)
    if (m_blocks.enter(origin) == m_origins.size()) m_origins.push_back(origin);
  m_values = std::make_unique_for_overwrite<float[]>(m_origins.size() * kBlockValues);
  forBlocks(m_origins.size(), [&](const FloatGrid::ConstAccessor& acc, std::size_t i) {
    gather(acc, m_origins[i], scale, m_values.get() + i * kBlockValues);
  });
}

LevelSet::Sample LevelSet::sample(const Vec3f& x) const {
  Sample s;
  const int i = cellAlong(x.x()), j = cellAlong(x.y()), k = cellAlong(x.z());
  const std::uint32_t block = find(Coord(i & ~7, j & ~7, k & ~7));
  if (block == kNone) return s;

  const float tx = x.x() - float(i), ty = x.y() - float(j), tz = x.z() - float(k);
  const auto wx = catmullRom(tx), wy = catmullRom(ty), wz = catmullRom(tz);
  const auto dx = catmullRomSlope(tx), dy = catmullRomSlope(ty), dz = catmullRomSlope(tz);
  const float* corner = values(block) + ((i & 7) * kBlockPadded + (j & 7)) * kBlockPadded + (k & 7);
  Float4 value{}, alongX{}, alongY{};
  for (int a = 0; a < 4; ++a) {
    Float4 sum{}, slope{};
    for (int b = 0; b < 4; ++b) {
      const Float4 row = load4(corner + (a * kBlockPadded + b) * kBlockPadded);
      sum += wy[b] * row;
      slope += dy[b] * row;
    }
    value += wx[a] * sum;
    alongX += dx[a] * sum;
    alongY += wx[a] * slope;
  }
  for (int c = 0; c < 4; ++c) {
    s.value += wz[c] * value[c];
    s.gradient += Vec3f(wz[c] * alongX[c], wz[c] * alongY[c], dz[c] * value[c]);
  }
  s.known = true;
  return s;
}

float LevelSet::sampleScale(const Vec3f& x) const {
  const int i = cellAlong(x.x()), j = cellAlong(x.y()), k = cellAlong(x.z());
  const std::uint32_t block = find(Coord(i & ~7, j & ~7, k & ~7));
  if (block == kNone) return 1.0f;
  const float* corner = m_scale.data() + std::size_t(block) * kScaled * kScaled * kScaled +
                        ((i & 7) * kScaled + (j & 7)) * kScaled + (k & 7);
  const float u = x.x() - float(i), v = x.y() - float(j), w = x.z() - float(k);
  const auto row = [&](int offset) { return corner[offset] + w * (corner[offset + 1] - corner[offset]); };
  const auto plane = [&](int offset) { return row(offset) + v * (row(offset + kScaled) - row(offset)); };
  return plane(0) + u * (plane(kScaled * kScaled) - plane(0));
}

LevelSet::Projection LevelSet::project(const Vec3f& x, float reach) const {
  constexpr int kSteps = 6;
  constexpr float kOnSurface = 2e-4f;  // voxels: float positions resolve no more in a large grid
  constexpr float kFlat = 0.05f;       // a gradient smaller than this (1 for a true distance) points nowhere
  Projection best;
  best.position = x;
  best.distance = reach + 1.0f;
  Vec3f at = x;
  for (int step = 0; step < kSteps; ++step) {
    const Sample s = sample(at);
    if (!s.known) break;
    const float length2 = s.gradient.lengthSqr();
    if (length2 < kFlat * kFlat) break;
    const float left = std::abs(s.value);
    if (left < best.distance || !best.known) {
      best.position = at;
      best.normal = s.gradient / std::sqrt(length2);
      best.distance = left;
      best.known = true;
    }
    if (left < kOnSurface) break;
    Vec3f move = s.gradient * (-s.value / length2);
    const float length = move.length();
    if (length > 0.5f) move *= 0.5f / length;
    at += move;
    if ((at - x).lengthSqr() > reach * reach) break;
  }
  return best;
}

LevelSet::Projection LevelSet::slide(const Vec3f& x, float reach) const {
  constexpr float kNear = 0.05f;  // voxels: one step is enough from here
  constexpr float kSteep = 0.5f;  // least gradient for it
  const Sample s = sample(x);
  const float length2 = s.gradient.lengthSqr();
  if (!s.known || std::abs(s.value) > kNear || length2 < kSteep * kSteep) return project(x, reach);
  Projection result;
  result.position = x - s.gradient * (s.value / length2);
  result.normal = s.gradient / std::sqrt(length2);
  result.known = true;
  return result;
}

}  // namespace fluidtex::texture
