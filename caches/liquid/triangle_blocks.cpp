#include "caches/liquid/triangle_blocks.h"

#include "sim/grid/mac_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;
using openvdb::Vec3I;

constexpr std::size_t kTogether = 4096;  // triangles
constexpr std::uint64_t kFewBlocks = 8;

struct Entry {
  Coord block;
  std::uint32_t triangle;
};

int blockOf(double cell) {
  return int(std::floor(cell / sim::kLeafDim));
}

// Long triangles come near few of the blocks in the box around them: parts of the box from which they are too
// far are left out.
void addNear(const CellTriangles& surface, std::uint32_t triangle, const CoordBBox& box, double reach,
             std::vector<Entry>& entries) {
  const Vec3d low = sim::kLeafDim * box.min().asVec3d(),
              high = sim::kLeafDim * box.max().asVec3d() + Vec3d(sim::kLeafDim - 1);
  const double farthest = 0.5 * (high - low).length() + reach;
  if (closestPoint(surface, triangle, 0.5 * (low + high)).square > farthest * farthest) return;
  const Coord count = box.dim();
  const int axis = int(openvdb::math::MaxIndex(count));
  if (count[axis] == 1) {
    entries.push_back({box.min(), triangle});
    return;
  }
  CoordBBox lower = box, upper = box;
  lower.max()[axis] = box.min()[axis] + count[axis] / 2 - 1;
  upper.min()[axis] = lower.max()[axis] + 1;
  addNear(surface, triangle, lower, reach, entries);
  addNear(surface, triangle, upper, reach, entries);
}

void addTriangle(const CellTriangles& surface, std::uint32_t triangle, double reach,
                 std::vector<Entry>& entries) {
  if (!surface.counts(triangle)) return;
  const Vec3I& t = surface.triangles[triangle];
  CoordBBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const float a = surface.points[t[0]][axis], b = surface.points[t[1]][axis],
                c = surface.points[t[2]][axis];
    box.min()[axis] = blockOf(std::ceil(double(std::min({a, b, c})) - reach));
    box.max()[axis] = blockOf(double(std::max({a, b, c})) + reach);
    if (box.min()[axis] > box.max()[axis]) return;
  }
  if (box.volume() > kFewBlocks) {
    addNear(surface, triangle, box, reach, entries);
    return;
  }
  for (int i = box.min()[0]; i <= box.max()[0]; ++i)
    for (int j = box.min()[1]; j <= box.max()[1]; ++j)
      for (int k = box.min()[2]; k <= box.max()[2]; ++k) entries.push_back({Coord(i, j, k), triangle});
}

}  // namespace

TriangleBlocks trianglesByBlock(const CellTriangles& surface, double reach) {
  const std::size_t count = surface.triangles.size();
  std::vector<std::vector<Entry>> entries((count + kTogether - 1) / kTogether);
  tbb::parallel_for(std::size_t{0}, entries.size(), [&](std::size_t n) {
    entries[n].reserve(2 * kTogether);
    for (std::size_t t = n * kTogether; t < std::min(count, (n + 1) * kTogether); ++t)
      addTriangle(surface, std::uint32_t(t), reach, entries[n]);
  });
  TriangleBlocks result;
  openvdb::Int32Tree numbers(-1);
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> accessor(numbers);
  std::vector<std::uint32_t> blockOfEntry;
  result.first = {0, 0};  // of block n first at n + 2
  for (const auto& some : entries)
    for (const Entry& entry : some) {
      int number = accessor.getValue(entry.block);
      if (number < 0) {
        number = int(result.blocks.size());
        accessor.setValue(entry.block, number);
        result.blocks.push_back(entry.block);
        result.first.push_back(0);
      }
      ++result.first[std::size_t(number) + 2];
      blockOfEntry.push_back(std::uint32_t(number));
    }
  for (std::size_t n = 2; n < result.first.size(); ++n) result.first[n] += result.first[n - 1];
  result.triangles.resize(blockOfEntry.size());
  std::size_t at = 0;
  for (const auto& some : entries)
    for (const Entry& entry : some) result.triangles[result.first[blockOfEntry[at++] + 1]++] = entry.triangle;
  result.first.pop_back();
  return result;
}

}  // namespace fluidtex::caches
