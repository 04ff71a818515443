#include "sim/markers/markers.h"

#include "numerics/random.h"
#include "sim/grid/block_samples.h"
#include "sim/grid/leaf_table.h"
#include "sim/markers/marker_side.h"
#include "sim/markers/marker_sight.h"
#include "sim/markers/stray_markers.h"
#include "sim/solids/solid_layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::sim {
namespace {

using Vec3f = openvdb::Vec3f;

// Distances here are in cells.
constexpr float kSmallest = 0.1f, kLargest = 0.5f;  // radii [Enright02 sec. 3.1]
constexpr int kPerCell = 16;                        // markers of a full cell
constexpr float kBand = 1.5f;                       // cells: largest distance of markers from the surface
// Largest depth in solids at which markers are seeded.
constexpr float kWallDepth = 0.5f;
// Air markers this many cells inside the liquid belong to a bubble that has closed.
constexpr float kDeepestAir = 1.0f;

// Random numbers of a cell, independent of the order of cells. 20 bits each, so that 7 + x stays below 8.
class CellRandom {
 public:
  CellRandom(std::uint64_t seed, const Coord& cell) : m_state(seed) {
    for (int a = 0; a < 3; ++a) m_state = randomBits(m_state, static_cast<std::uint32_t>(cell[a]));
  }

  // The n-th point of the unit cube.
  Vec3f point(std::uint32_t n) const {
    const std::uint64_t bits = randomBits(m_state, n);
    const auto part = [&](int shift) { return static_cast<float>(bits >> shift & 0xfffff) * 0x1p-20f; };
    return Vec3f(part(44), part(24), part(4));
  }

 private:
  std::uint64_t m_state;
};

// Whether the liquid here is only a film on the wall: no cell around is liquid, and the distance to the
// liquid grows one cell away from the wall. (Beside a thread that stands on a wall it does not.)
bool liesOnWall(const Marker& m, const BlockSamples& distance, const BlockSamples& solid) {
  if (distance.anyNegative(m.x, m.y, m.z)) return false;
  const Vec3f slope(solid.at(m.x + 0.5f, m.y, m.z) - solid.at(m.x - 0.5f, m.y, m.z),
                    solid.at(m.x, m.y + 0.5f, m.z) - solid.at(m.x, m.y - 0.5f, m.z),
                    solid.at(m.x, m.y, m.z + 0.5f) - solid.at(m.x, m.y, m.z - 0.5f));
  const float length = slope.length();
  if (length < 0.1f) return true;  // in the middle of a solid
  const Vec3f away = Vec3f(m.x, m.y, m.z) + slope / length;
  return distance.at(away[0], away[1], away[2]) > distance.at(m.x, m.y, m.z) + 0.5f;
}

// Halo that VisibleCells reach around a marker's nearest cell, beside thin walls.
constexpr int kThinWallHalo = VisibleCells::kReach + 1;

// A corner of the cube of cell centres around a marker, as an index into VisibleCells of its nearest cell.
int cornerOf(const Marker& m, int corner) {
  constexpr const int* kStride = VisibleCells::kStride;
  return VisibleCells::kMiddle + (int(m.x) + (corner >> 2) - nearestCell(m.x)) * kStride[0] +
         (int(m.y) + ((corner >> 1) & 1) - nearestCell(m.y)) * kStride[1] +
         (int(m.z) + (corner & 1) - nearestCell(m.z)) * kStride[2];
}

bool seesCorners(const VisibleCells& visible, const Marker& m) {
  for (int corner = 0; corner < 8; ++corner)
    if (!visible.sees(cornerOf(m, corner))) return false;
  return true;
}

// phi, in cells, at a marker.
float sample(const BlockSamples& distance, const Marker& m, const VisibleCells* visible) {
  if (visible == nullptr || visible->seesNear() || seesCorners(*visible, m))
    return distance.at(m.x, m.y, m.z);
  constexpr int kReach = VisibleCells::kReach;
  Stencil values;
  float* to = values.data();
  for (int i = -kReach; i <= kReach; ++i)
    for (int j = -kReach; j <= kReach; ++j, to += VisibleCells::kSide)
      std::copy_n(distance.sample(nearestCell(m.x) + i, nearestCell(m.y) + j, nearestCell(m.z) - kReach),
                  VisibleCells::kSide, to);
  extrapolateBehind(values, *visible);
  return trilinear(values.data() + cornerOf(m, 0), VisibleCells::kStride[0], VisibleCells::kStride[1],
                   m.x - std::floor(m.x), m.y - std::floor(m.y), m.z - std::floor(m.z));
}

void measure(Marker& m, float phi) {
  m.radius = sideOf(m) * std::clamp(sideOf(m) * phi, kSmallest, kLargest);
}

}  // namespace

void correctPhi(FloatGrid& phi, const Markers& markers, const FloatGrid& solidPhi,
                const Visibility* visibility) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  Markers out(markers.size());  // those that have escaped
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    thread_local BlockSamples distance(1), solid(1);
    thread_local CellRanges range;
    const Sight sight(visibility, markers[n].origin);
    distance.setHalo(sight.any() ? kThinWallHalo : 1);
    distance.load(phi.constTree(), markers[n].origin, 1.0f / h);
    range.find(distance);
    bool loaded = false;
    const auto isInSolid = [&](const Marker& m) {
      if (!loaded) solid.load(solidPhi.constTree(), markers[n].origin, 1.0f / h);
      loaded = true;
      return solid.at(m.x, m.y, m.z) < 0.0f;
    };
    out[n].origin = markers[n].origin;
    const float wrong = kSmallest - CellRanges::kRounding;
    for (const Marker& m : markers[n].markers) {
      const auto cell = std::size_t(cellOf(m));
      const VisibleCells* visible = sight.at(m);
      if (visible == nullptr && (m.radius < 0.0f ? range.high[cell] < wrong : range.low[cell] > -wrong))
        continue;
      if (escaped(m, sample(distance, m, visible)) && !isInSolid(m)) out[n].markers.push_back(m);
    }
  });
  std::erase_if(out, [](const MarkerBlock& block) { return block.markers.empty(); });
  if (out.empty()) return;

  const auto leaves = leavesOf(phi.tree());
  const float background = phi.background();
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* value = leaves[n]->buffer().data();
    std::array<float, kLeafSize> air, liquid;
    bool touched = false;
    for (int from = 0; from < 8; ++from) {
      const Coord shift(-(from >> 2) * kLeafDim, -((from >> 1) & 1) * kLeafDim, -(from & 1) * kLeafDim);
      const MarkerBlock* block = findBlock(out, leaves[n]->origin() + shift);
      if (block == nullptr) continue;
      if (!touched) {
        std::copy_n(value, kLeafSize, air.begin());
        std::copy_n(value, kLeafSize, liquid.begin());
        touched = true;
      }
      const Sight sight(visibility, block->origin);
      for (const Marker& m : block->markers) {
        const VisibleCells* visible = sight.at(m);
        for (int corner = 0; corner < 8; ++corner) {
          const int i = int(m.x) + (corner >> 2) + shift[0], j = int(m.y) + ((corner >> 1) & 1) + shift[1],
                    k = int(m.z) + (corner & 1) + shift[2];
          if (visible != nullptr && !visible->sees(cornerOf(m, corner))) continue;
          if (i < 0 || j < 0 || k < 0 || i >= kLeafDim || j >= kLeafDim || k >= kLeafDim) continue;
          const float dx = m.x + float(shift[0] - i), dy = m.y + float(shift[1] - j),
                      dz = m.z + float(shift[2] - k);
          const float far = std::sqrt(dx * dx + dy * dy + dz * dz);
          const int at = 64 * i + 8 * j + k;
          if (m.radius < 0.0f)
            liquid[at] = std::min(liquid[at], h * (far + m.radius));
          else
            air[at] = std::max(air[at], h * (m.radius - far));
        }
      }
    }
    if (!touched) return;
    float scratch[kLeafSize];
    const float* solid = leafValues(solidPhi.constTree(), leaves[n]->origin(), scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      if (solid[i] < -kDeepInSolid * h) continue;
      const float right = std::abs(air[i]) <= std::abs(liquid[i]) ? air[i] : liquid[i];
      value[i] = std::clamp(right, -background, background);
    }
  });
}

Markers seedMarkers(const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed,
                    const Visibility* visibility) {
  Markers markers;
  maintainMarkers(markers, phi, solidPhi, seed, visibility);
  return markers;
}

void maintainMarkers(Markers& markers, const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed,
                     const Visibility* visibility) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  std::vector<Coord> origins;
  for (const MarkerBlock& block : markers) origins.push_back(block.origin);
  for (const FloatLeaf* leaf : leavesOf(phi.constTree())) origins.push_back(leaf->origin());
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  Markers next(origins.size());
  std::vector<Suspects> suspects(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    thread_local BlockSamples distance(kStrayHalo), solid(2);
    thread_local CellRanges range, wallRange;
    const Sight sight(visibility, origins[n]);
    distance.setHalo(sight.any() ? kThinWallHalo : kStrayHalo);
    distance.load(phi.constTree(), origins[n], 1.0f / h);
    solid.load(solidPhi.constTree(), origins[n], 1.0f / h);
    range.find(distance);
    wallRange.find(solid);
    next[n].origin = origins[n];
    thread_local std::vector<Marker> kept;
    kept.clear();
    std::array<int, kLeafSize> count{};
    constexpr float kRounding = CellRanges::kRounding;
    if (MarkerBlock* block = findBlock(markers, origins[n])) {
      for (Marker m : block->markers) {
        const auto cell = std::size_t(cellOf(m));
        int& there = count[cell];
        const bool open = wallRange.low[cell] > kRounding - 1.0f;
        const float here = sample(distance, m, sight.at(m));
        const bool out = escaped(m, here);
        if (sideOf(m) * here > kBand) continue;
        if (out && m.radius > 0.0f && -here > kDeepestAir) continue;
        if (!open || out) {
          const float wall = solid.at(m.x, m.y, m.z);
          if (wall < -1.0f) continue;
          // Liquid that runs over a wall leaves no air between, since air cannot flow out there.
          if (out && m.radius > 0.0f && wall < 1.0f) continue;
          // The rest of a film at a wall, without a liquid cell: nothing would move it any more.
          if (out && wall < 1.0f && liesOnWall(m, distance, solid)) continue;
        }
        if (!out && there >= 2 * kPerCell) continue;
        ++there;
        if (out && !sight.any() && mayBeStray(m, here, distance))
          suspects[n].marker.push_back(static_cast<std::uint32_t>(kept.size()));
        measure(m, here);
        kept.push_back(m);
      }
      block->markers = std::vector<Marker>();  // frees the memory early
    }
    suspects[n].voters = kept.size();
    for (std::size_t c = 0; c < kLeafSize; ++c) {
      if (count[c] > kPerCell / 2) continue;
      const bool farOff = range.low[c] > kBand + kRounding || range.high[c] < -kBand - kRounding;
      if (farOff && !sight.any()) continue;
      if (wallRange.high[c] < -kWallDepth - kRounding) continue;
      const Coord local(int(c >> 6), int(c >> 3 & 7), int(c & 7));
      const Vec3f corner(local.asVec3s());
      // From the middle to a corner it is less than a cell.
      if (!sight.any() &&
          std::abs(distance.at(corner[0] + 0.5f, corner[1] + 0.5f, corner[2] + 0.5f)) > kBand + 1.0f)
        continue;
      const CellRandom random(seed, origins[n] + local);
      for (int m = count[c]; m < kPerCell; ++m) {
        const Vec3f at = corner + random.point(std::uint32_t(m));
        Marker added{at[0], at[1], at[2], 0.0f};
        const float here = sample(distance, added, sight.at(added));
        if (std::abs(here) > kBand || solid.at(at[0], at[1], at[2]) < -kWallDepth) continue;
        added.radius = here < 0.0f ? -kSmallest : kSmallest;
        measure(added, here);
        kept.push_back(added);
      }
    }
    next[n].markers = kept;
  });
  dropOutvoted(next, suspects, phi);
  std::erase_if(next, [](const MarkerBlock& block) { return block.markers.empty(); });
  markers = std::move(next);
}

}  // namespace fluidtex::sim
