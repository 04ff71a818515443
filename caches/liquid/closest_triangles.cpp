#include "caches/liquid/closest_triangles.h"

#include "caches/liquid/triangle_blocks.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;
using sim::kLeafSize;

using BlockNumbers = openvdb::tree::ValueAccessor<openvdb::Int32Tree>;

constexpr std::uint32_t kNone = ~0u;
// Each cell is nearer than one of its neighbours along the axes by that much at least: 1 / sqrt 3.
constexpr double kReachStep = 0.577;

// Whether any of a block's cells on the side towards direction 0..5 (as in sim::LeafTable::next) is set.
bool touchesSide(const sim::LeafBits& bits, int direction) {
  constexpr std::uint64_t kFirstRow = 0xff, kFirst = 0x0101010101010101ull;
  if (direction == 0) return bits.front() != 0;
  if (direction == 1) return bits.back() != 0;
  const std::uint64_t side = direction == 2   ? kFirstRow
                             : direction == 3 ? kFirstRow << 56
                             : direction == 4 ? kFirst
                                              : kFirst << 7;
  return std::any_of(bits.begin(), bits.end(), [=](std::uint64_t word) { return (word & side) != 0; });
}

std::unique_ptr<BlockNearest> nothingNear() {
  auto nearest = std::make_unique<BlockNearest>();
  nearest->square.fill(std::numeric_limits<float>::max());
  nearest->triangle.fill(kNone);
  return nearest;
}

// The cells nearer than the root of `square`.
sim::LeafBits nearerThan(float square, const BlockNearest& nearest) {
  sim::LeafBits bits{};
  for (int cell = 0; cell < kLeafSize; ++cell)
    bits[std::size_t(cell >> 6)] |= std::uint64_t{nearest.square[std::size_t(cell)] < square} << (cell & 63);
  return bits;
}

}  // namespace

ClosestTriangles::ClosestTriangles(const SurfaceTriangles& surface, double h)
    : m_cellSize(h), m_reach(kRasterReach), m_asGiven(surface), m_surface(cellTriangles(surface, h)) {
  const TriangleBlocks triangles = trianglesByBlock(m_surface, kRasterReach);
  for (const Coord& block : triangles.blocks) addBlock(block);
  m_crossed.resize(m_blocks.size());
  sim::forLeaves(m_blocks, [&](std::size_t n) {
    const Vec3d first = (m_blocks.origins[n] - m_surface.origin).asVec3d();
    for (const std::uint32_t triangle : triangles.of(n)) {
      BlockTriangle corners;
      for (int corner = 0; corner < 3; ++corner)
        corners[std::size_t(corner)] = Vec3d(m_surface.points[m_surface.triangles[triangle][corner]]) - first;
      rasterDistances(corners, triangle, *m_nearest[n]);
      rasterCrossings(corners, m_crossed[n]);
    }
    m_known[n] = nearerThan(float(kRasterReach * kRasterReach), *m_nearest[n]);
  });
}

void ClosestTriangles::addBlock(const Coord& block) {
  BlockNumbers numbers(m_numbers);
  const auto number = std::int32_t(m_blocks.size());
  numbers.setValue(block, number);
  m_blocks.origins.push_back(m_surface.origin + Coord(block[0] << 3, block[1] << 3, block[2] << 3));
  m_blocks.next.emplace_back();
  for (int direction = 0; direction < 6; ++direction) {
    Coord there = block;
    there[direction >> 1] += direction & 1 ? 1 : -1;
    const std::int32_t next = numbers.getValue(there);
    m_blocks.next.back()[std::size_t(direction)] = next;
    if (next >= 0) m_blocks.next[std::size_t(next)][std::size_t(direction ^ 1)] = number;
  }
  m_known.emplace_back();
  m_nearest.push_back(nothingNear());
}

void ClosestTriangles::addNeighbors() {
  const std::size_t count = m_blocks.size();
  for (std::size_t n = 0; n < count; ++n)
    for (int direction = 0; direction < 6; ++direction) {
      if (m_blocks.next[n][std::size_t(direction)] >= 0 || !touchesSide(m_known[n], direction)) continue;
      const Coord from = m_blocks.origins[n] - m_surface.origin;
      Coord there(from[0] >> 3, from[1] >> 3, from[2] >> 3);
      there[direction >> 1] += direction & 1 ? 1 : -1;
      addBlock(there);
    }
}

Vec3d ClosestTriangles::placeOf(std::int64_t cell) const {
  return (m_blocks.coord(cell) - m_surface.origin).asVec3d();
}

Nearest ClosestTriangles::at(std::int64_t cell) const {
  const BlockNearest& block = *m_nearest[std::size_t(cell >> 9)];
  return {block.square[std::size_t(cell & 511)], block.triangle[std::size_t(cell & 511)]};
}

TrianglePoint ClosestTriangles::closestPointOf(std::int64_t cell) const {
  return closestPoint(m_surface, at(cell).triangle, placeOf(cell));
}

std::vector<ClosestTriangles::Found> ClosestTriangles::findAround(std::size_t block, float square,
                                                                  float lastSquare) const {
  sim::LeafBits cells = sim::besideAny(m_blocks, m_known, block);
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] &= ~m_known[block][i];
  std::vector<Found> found;
  sim::forBits(cells, block, [&](std::int64_t cell) {
    const Vec3d place = placeOf(cell);
    const Nearest before = at(cell);
    Nearest best = before;
    bool isAsked = false;
    for (int direction = 0; direction < 6; ++direction) {
      const std::int64_t neighbor = m_blocks.neighbor(cell, direction);
      if (neighbor < 0 || !sim::isSet(m_known, neighbor)) continue;
      const auto [squareThere, triangle] = at(neighbor);
      // What was known a round before has been asked then.
      if (squareThere < lastSquare && before.triangle != kNone) continue;
      isAsked = true;
      if (triangle == best.triangle) continue;
      const TrianglePoint closest = closestPoint(m_surface, triangle, place);
      if (closest.square < double(best.square)) best = descend(m_surface, place, triangle, closest);
    }
    if (isAsked && best.triangle == before.triangle)
      best = descend(m_surface, place, best.triangle, closestPoint(m_surface, best.triangle, place));
    if (best.square < square || best.triangle != before.triangle)
      found.push_back({std::int16_t(cell & 511), best.square < square, best});
  });
  return found;
}

void ClosestTriangles::extend(double reach) {
  while (m_reach < reach) {
    const double next = std::min(m_reach + kReachStep, reach);
    const auto square = float(next * next), lastSquare = float(m_lastReach * m_lastReach);
    addNeighbors();
    std::vector<std::vector<Found>> found(m_blocks.size());
    sim::forLeaves(m_blocks, [&](std::size_t n) { found[n] = findAround(n, square, lastSquare); });
    sim::forLeaves(m_blocks, [&](std::size_t n) {
      for (const Found& cell : found[n]) {
        m_nearest[n]->square[std::size_t(cell.offset)] = cell.nearest.square;
        m_nearest[n]->triangle[std::size_t(cell.offset)] = cell.nearest.triangle;
        if (cell.isNear) sim::setBit(m_known[n], cell.offset);
      }
    });
    m_lastReach = std::exchange(m_reach, next);
  }
}

}  // namespace fluidtex::caches
