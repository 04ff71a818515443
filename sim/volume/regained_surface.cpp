#include "sim/volume/regained_surface.h"

#include "sim/grid/leaf_patch.h"
#include "sim/grid/mac_grid.h"
#include "sim/markers/drop_markers.h"
#include "sim/surface/cell_volume.h"
#include "sim/volume/deficit_grid.h"
#include "sim/volume/volume_deficit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace fluidtex::sim {
namespace {

// Share of a cell's volume. Half would reach its centre, but drops that small are lost again in the next
// step, and look too large meanwhile.
constexpr float kFills = 0.9f;
// Cells of which less than this share is open are too small for a surface of their own.
constexpr float kRoomy = 0.75f;

// Shares of a cell's volume: at least kShows is inside the surface, and less than kEmpty of liquid is left.
constexpr float kShows = 0.3f, kEmpty = 0.05f;
// Where the liquid is deeper than this, in cells, in a cell or beside it, it is not a speck.
constexpr float kShallow = 0.5f;

struct Regained {
  Coord cell;
  float share;  // liquid share of the cell
};

// Makes a source's own liquid air in a patch of phi: with its velocity given, it takes no deficit.
void leaveOut(LeafPatch& distance, const SourceGrids& source, const Coord& origin) {
  if (source.velocity[0] == nullptr) return;
  const LeafPatch shape = patchOf(source.phi->constTree(), origin);
  for (std::size_t at = 0; at < LeafPatch::size(); ++at)
    if (shape[at] < 0.0f) distance[at] = std::max(0.0f, distance[at]);
}

std::vector<Regained> regainedIn(const FloatLeaf& deficit, const FloatTree& phi, const SolidField& solid,
                                 const RunningFlows& flows) {
  const float* due = deficit.buffer().data();
  std::vector<Regained> found;
  if (std::none_of(due, due + kLeafSize, [](float v) { return v > kFills; })) return found;
  LeafShares open;
  openShares(solid, deficit.origin(), open);
  const LeafPatch here = patchOf(phi, deficit.origin());
  LeafPatch distance = here;
  for (const auto& running : flows.sources) leaveOut(distance, *running.source, deficit.origin());
  const LeafPatch wall = patchOf(solid.phi->constTree(), deficit.origin());
  // Behind a solid's surface phi is extrapolated.
  const auto isLiquid = [&](int at) { return distance[at] < 0.0f && wall[at] > 0.0f; };
  for (int i = 0; i < kLeafSize; ++i) {
    const int at = patchIndex(i);
    const Coord cell = deficit.offsetToGlobalCoord(i);
    if (due[i] <= kFills || open[i] < kRoomy || !solid.domain.isInside(cell)) continue;
    bool dry = here[at] >= 0.0f;
    for (const int stride : kPatchStride) dry = dry && !isLiquid(at - stride) && !isLiquid(at + stride);
    if (dry) found.push_back({cell, std::min(due[i], 1.0f)});
  }
  return found;
}

// A cell and its six neighbours.
std::array<Coord, 7> star(const Coord& cell) {
  std::array<Coord, 7> cells;
  cells.fill(cell);
  for (int n = 0; n < 6; ++n) cells[n][n / 2] += n % 2 == 0 ? -1 : 1;
  return cells;
}

// Cells inside a surface that holds almost no liquid.
std::vector<Coord> emptyIn(const FloatLeaf& deficit, const FloatGrid& phi, const SolidField& solid) {
  const float* due = deficit.buffer().data();
  std::vector<Coord> found;
  if (std::none_of(due, due + kLeafSize, [](float v) { return v < kEmpty - kShows; })) return found;
  LeafShares shown;
  liquidShares(phi, solid, deficit.origin(), shown);
  const LeafPatch distance = patchOf(phi.constTree(), deficit.origin());
  const float deep = -kShallow * static_cast<float>(solid.voxelSize);
  for (int i = 0; i < kLeafSize; ++i) {
    const int at = patchIndex(i);
    bool shallow = distance[at] < 0.0f && distance[at] > deep;
    for (const int stride : kPatchStride)
      shallow = shallow && distance[at - stride] > deep && distance[at + stride] > deep;
    if (shallow && shown[i] > kShows && shown[i] + due[i] < kEmpty)
      found.push_back(deficit.offsetToGlobalCoord(i));
  }
  return found;
}

}  // namespace

void regainSurface(FloatGrid& phi, Markers& markers, FloatGrid& deficit, const SolidField& solid,
                   const RunningFlows& flows) {
  const auto leaves = leavesOf(deficit.constTree());
  std::vector<std::vector<Regained>> parts(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(),
                    [&](std::size_t n) { parts[n] = regainedIn(*leaves[n], phi.constTree(), solid, flows); });
  std::vector<Regained> regained;
  for (const auto& part : parts) regained.insert(regained.end(), part.begin(), part.end());
  if (regained.empty()) return;

  std::set<Coord> cells;
  MaskGrid where;
  for (const Regained& r : regained) {
    where.tree().setValueOn(r.cell);
    for (const Coord& cell : star(r.cell)) cells.insert(cell);
  }
  const ShownLiquid before = shownAround(where, phi, solid);
  const float h = static_cast<float>(phi.voxelSize()[0]);
  for (const Coord& cell : cells) phi.tree().touchLeaf(cell);
  for (const Regained& r : regained) {
    const float here = (0.5f - r.share) * h;
    for (const Coord& cell : star(r.cell)) {
      const float distance = cell == r.cell ? here : here + h;
      phi.tree().setValueOn(cell, std::min(phi.tree().getValue(cell), distance));
    }
  }
  dropMarkers(markers,
              [&](const Marker& m, const Coord& cell) { return m.radius > 0.0f && cells.contains(cell); });
  addChange(deficit, before, phi, solid);
}

void withdrawSurface(FloatGrid& phi, Markers& markers, FloatGrid& deficit, const SolidField& solid) {
  const auto leaves = leavesOf(deficit.constTree());
  std::vector<std::vector<Coord>> parts(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(),
                    [&](std::size_t n) { parts[n] = emptyIn(*leaves[n], phi, solid); });
  std::set<Coord> cells;
  MaskGrid where;
  for (const auto& part : parts) {
    for (const Coord& cell : part) {
      cells.insert(cell);
      where.tree().setValueOn(cell);
    }
  }
  if (cells.empty()) return;
  const ShownLiquid before = shownAround(where, phi, solid);
  const float dry = 0.5f * static_cast<float>(phi.voxelSize()[0]);
  for (const Coord& cell : cells) phi.tree().setValueOn(cell, dry);
  dropMarkers(markers,
              [&](const Marker& m, const Coord& cell) { return m.radius < 0.0f && cells.contains(cell); });
  addChange(deficit, before, phi, solid);
}

}  // namespace fluidtex::sim
