#include "sim/volume/volume_deficit.h"

#include "sim/grid/leaf_patch.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/surface/cell_volume.h"
#include "sim/surface/level_set.h"
#include "sim/volume/volume_flux.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace fluidtex::sim {
namespace {

// No more than this share of a cell is given back at once.
constexpr float kMost = 0.5f;
// Rounds in which what is owed in the air falls towards the liquid, a cell each.
constexpr int kGatherRounds = 4;
// Steps of diffusion in the liquid. Fluxes know a smooth surface to some hundredths of a cell, too much here
// and too little there: this evens out before it moves the surface.
constexpr int kSpreadRounds = 10;
// Less than this share of a cell is nothing.
constexpr float kNothing = 1e-6f;
// What is owed in cells with less room than this share stays where it is.
constexpr float kCarries = 1e-3f;
// Rounds in which what a cell cannot hold goes on, a cell each.
constexpr int kPileRounds = 6;
// Solid, to what looks for the liquid, in cells.
constexpr float kFar = 1e3f;

// The leaves in which something can be owed; `inside` the liquid, too.
LeafTable leavesAround(const FloatGrid& before, const FloatGrid& after, const FloatGrid* deficit, bool inside,
                       const CoordBBox& domain) {
  FloatTree topology(0.0f);
  const auto touch = [&](const Coord& origin) {
    if (domain.isInside(origin)) topology.touchLeaf(origin);
  };
  for (auto leaf = before.constTree().cbeginLeaf(); leaf; ++leaf) touch(leaf->origin());
  for (auto leaf = after.constTree().cbeginLeaf(); leaf; ++leaf) touch(leaf->origin());
  if (inside) {
    for (const Coord& origin : wetLeaves(before, domain)) touch(origin);
  }
  if (deficit != nullptr) {
    for (auto leaf = deficit->constTree().cbeginLeaf(); leaf; ++leaf) {
      for (int n = 0; n < 27; ++n)
        touch(leaf->origin().offsetBy(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1),
                                      kLeafDim * (n % 3 - 1)));
    }
  }
  return makeLeafTable(topology);
}

bool isZero(const LeafPatch& patch) {
  return std::none_of(patch.begin(), patch.end(), [](float v) { return v != 0.0f; });
}

// Where a voxel's row of 8 in z begins, in a leaf and in its patch.
template <class Body>
void forRows(const Body& body) {
  for (int row = 0; row < kLeafSize; row += kLeafDim) body(row, patchIndex(row));
}

// Whether liquid can go from a cell to the one beside it along an axis. faces: open shares.
bool isWay(const LeafPatch& faces, const LeafPatch& room, int at, int axis, bool up) {
  const int stride = kPatchStride[axis];
  return faces[up ? at + stride : at] > 0.0f && room[up ? at + stride : at - stride] > 0.0f &&
         room[at] > 0.0f;
}

// What is owed in cells of air falls towards the liquid, to the neighbours that are nearer to it. phi: `far`
// or more in solids.
void gatherInLiquid(const LeafTable& leaves, const std::vector<float>& phi, float far,
                    std::vector<float>& deficit) {
  const auto none = [far](float) { return 2.0f * far; };  // nothing goes where there is no leaf
  // One over the sum of differences to lower neighbours; 0 where nothing is given on.
  std::vector<float> rate(deficit.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafPatch distance;
    loadPatch(leaves, phi, n, distance, none);
    for (int i = 0; i < kLeafSize; ++i) {
      const int at = patchIndex(i);
      float drop = 0.0f;
      for (const int stride : kPatchStride)
        drop += std::max(0.0f, distance[at] - distance[at - stride]) +
                std::max(0.0f, distance[at] - distance[at + stride]);
      rate[n * kLeafSize + i] = distance[at] >= 0.0f && drop > 0.0f ? 1.0f / drop : 0.0f;
    }
  });
  for (int round = 0; round < kGatherRounds; ++round) {
    std::vector<float> next(deficit.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      LeafPatch distance{}, give{}, value{};
      loadPatch(leaves, deficit, n, value, [](float) { return 0.0f; });
      if (isZero(value)) return;
      loadPatch(leaves, phi, n, distance, none);
      loadPatch(leaves, rate, n, give, [](float) { return 0.0f; });
      LeafPatch given;
      for (std::size_t at = 0; at < given.size(); ++at) given[at] = give[at] * value[at];
      forRows([&](int row, int first) {
        for (int k = 0; k < kLeafDim; ++k) {
          const int at = first + k;
          float sum = give[at] > 0.0f ? 0.0f : value[at];
          for (const int stride : kPatchStride) {
            sum += std::max(0.0f, distance[at - stride] - distance[at]) * given[at - stride];
            sum += std::max(0.0f, distance[at + stride] - distance[at]) * given[at + stride];
          }
          next[n * kLeafSize + row + k] = sum;
        }
      });
    });
    deficit.swap(next);
  }
}

// No cell holds more than its volume, or lacks more: where drops land, or liquid is pressed together, what is
// beyond that goes to the cells beside that it can reach. A round takes it a cell further.
void spreadPiles(const LeafTable& leaves, const SolidField& solid, const std::vector<float>& room,
                 std::vector<float>& deficit) {
  const auto excess = [](float due, float space) { return due - std::clamp(due, -space, space); };
  const auto& open = solid.open.component;
  for (int round = 0; round < kPileRounds; ++round) {
    // Of each cell's excess what goes through each side that is open.
    std::vector<float> given(deficit.size(), 0.0f);
    std::vector<char> gives(leaves.size(), 0);
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const std::size_t first = n * kLeafSize;
      for (std::size_t at = first; at < first + kLeafSize && gives[n] == 0; ++at)
        gives[n] = room[at] > 0.0f && excess(deficit[at], room[at]) != 0.0f;
      if (gives[n] == 0) return;
      std::array<LeafPatch, 3> faces;
      for (int a = 0; a < 3; ++a) gather(open[a]->constTree(), leaves.origins[n], 1, faces[a].data(), true);
      LeafPatch space{};
      loadPatch(leaves, room, n, space, [](float) { return 0.0f; });
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = patchIndex(i);
        int ways = 0;
        for (int a = 0; a < 3; ++a)
          ways += int(isWay(faces[a], space, at, a, false)) + int(isWay(faces[a], space, at, a, true));
        if (space[at] > 0.0f && ways > 0)
          given[first + i] = excess(deficit[first + i], space[at]) / static_cast<float>(ways);
      }
    });
    if (std::none_of(gives.begin(), gives.end(), [](char c) { return c != 0; })) return;
    std::vector<float> next(deficit.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const std::size_t first = n * kLeafSize;
      std::copy_n(deficit.data() + first, kLeafSize, next.data() + first);
      LeafPatch from{}, space{};
      const auto none = [](float) { return 0.0f; };
      loadPatch(leaves, given, n, from, none);
      if (isZero(from)) return;
      loadPatch(leaves, room, n, space, none);
      std::array<LeafPatch, 3> faces;
      for (int a = 0; a < 3; ++a) gather(open[a]->constTree(), leaves.origins[n], 1, faces[a].data(), true);
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = patchIndex(i);
        float sum = 0.0f;
        for (int a = 0; a < 3; ++a) {
          if (isWay(faces[a], space, at, a, false)) sum += from[at - kPatchStride[a]] - from[at];
          if (isWay(faces[a], space, at, a, true)) sum += from[at + kPatchStride[a]] - from[at];
        }
        next[first + i] += sum;
      }
    });
    deficit.swap(next);
  }
}

// Of the difference to each neighbour what goes there in a round. Alone most of these steps would not be
// stable, but the ten together are, and spread as far as 33 that are: Alexiades, Amiez, Gremaud,
// "Super-time-stepping acceleration of explicit schemes for parabolic problems", 1996. Long and short ones
// take turns.
float spreadShare(int round) {
  constexpr double kStable = 1.0 / 6.0, kDamping = 0.03;
  const double angle = (2 * (3 * round % kSpreadRounds) + 1) * std::numbers::pi / (2 * kSpreadRounds);
  return static_cast<float>(kStable / ((kDamping - 1.0) * std::cos(angle) + 1.0 + kDamping));
}

// Evens out what the cells of the liquid owe, as a share of their room.
void spreadInLiquid(const LeafTable& leaves, const std::vector<float>& phi, const std::vector<float>& room,
                    std::vector<float>& deficit) {
  std::vector<float> wet(deficit.size());
  for (std::size_t at = 0; at < deficit.size(); ++at) wet[at] = phi[at] < 0.0f ? room[at] : 0.0f;
  const auto none = [](float) { return 0.0f; };
  for (int round = 0; round < kSpreadRounds; ++round) {
    const float part = spreadShare(round);
    std::vector<float> next(deficit.size());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      LeafPatch space{}, value{}, share;
      loadPatch(leaves, deficit, n, value, none);
      if (isZero(value)) return;
      loadPatch(leaves, wet, n, space, none);
      for (std::size_t at = 0; at < share.size(); ++at)
        share[at] = space[at] > 0.0f ? value[at] / space[at] : 0.0f;
      forRows([&](int row, int first) {
        for (int k = 0; k < kLeafDim; ++k) {
          const int at = first + k;
          float sum = 0.0f;
          for (const int stride : kPatchStride) {
            sum += std::min(space[at], space[at - stride]) * (share[at - stride] - share[at]);
            sum += std::min(space[at], space[at + stride]) * (share[at + stride] - share[at]);
          }
          next[n * kLeafSize + row + k] = value[at] + part * sum;
        }
      });
    });
    deficit.swap(next);
  }
}

// What is beyond a side of the domain is gone.
void dropOutside(const LeafTable& leaves, const CoordBBox& domain, std::vector<float>& deficit) {
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (domain.isInside(CoordBBox::createCube(leaves.origins[n], kLeafDim))) continue;
    for (int i = 0; i < kLeafSize; ++i) {
      const Coord cell = leaves.origins[n].offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      if (!domain.isInside(cell)) deficit[n * kLeafSize + i] = 0.0f;
    }
  }
}

// Cells that sources fill up, and those of them whose faces have a source's velocity.
struct SourceCells {
  std::vector<FilledCell> filled;
  std::vector<std::size_t> given;
};

// was: the liquid shares before.
SourceCells cellsOf(const RunningFlows& flows, const LeafTable& leaves, const SolidField& solid,
                    const std::vector<float>& was) {
  const float near = static_cast<float>(solid.voxelSize);
  std::vector<SourceCells> found(leaves.size());
  for (const auto& running : flows.sources) {
    const FloatGrid& shape = *running.source->phi;
    const bool flowing = running.source->velocity[0] != nullptr;
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const Coord& origin = leaves.origins[n];
      if (shape.constTree().probeConstLeaf(origin) == nullptr && shape.constTree().getValue(origin) >= near)
        return;
      float scratch[kLeafSize];
      const float* distance = leafValues(shape.constTree(), origin, scratch);
      LeafShares held, room;
      liquidShares(shape, solid, origin, held);
      openShares(solid, origin, room);
      for (int i = 0; i < kLeafSize; ++i) {
        if (room[i] <= kCarries || held[i] <= 0.0f) continue;
        // Its own part, or, as full as it was where only the source's velocity leads out of it.
        const std::size_t cell = n * kLeafSize + i;
        const bool given = flowing && distance[i] < 0.0f;
        found[n].filled.push_back({cell, std::max(held[i] / room[i], given ? was[cell] : 0.0f), !given});
        if (given) found[n].given.push_back(cell);
      }
    });
  }
  SourceCells all;
  for (const SourceCells& some : found) {
    all.filled.insert(all.filled.end(), some.filled.begin(), some.filled.end());
    all.given.insert(all.given.end(), some.given.begin(), some.given.end());
  }
  return all;
}

// Nothing is owed within a cell of what is always empty.
void forgive(const LeafTable& leaves, const FloatGrid& shape, float h, std::vector<float>& deficit) {
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    float scratch[kLeafSize];
    const float* phi = leafValues(shape.constTree(), leaves.origins[n], scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      if (phi[i] < h) deficit[n * kLeafSize + i] = 0.0f;
    }
  }
}

FloatGrid::Ptr toGrid(const LeafTable& leaves, const std::vector<float>& deficit, double h) {
  auto grid = FloatGrid::create(0.0f);
  grid->setTransform(cellTransform(h));
  grid->setName("deficit");
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const float* values = deficit.data() + n * kLeafSize;
    if (std::all_of(values, values + kLeafSize, [](float v) { return std::abs(v) < kNothing; })) continue;
    FloatLeaf* leaf = grid->tree().touchLeaf(leaves.origins[n]);
    leaf->setValuesOn();
    std::copy_n(values, kLeafSize, leaf->buffer().data());
  }
  return grid;
}

}  // namespace

FloatGrid::Ptr volumeDeficit(const FloatGrid& before, const FloatGrid& after, const FloatGrid* deficit,
                             const Velocity& velocity, const SolidField& solid, const SolidField& solidAfter,
                             const RunningFlows& flows, double dt) {
  // Between two steps solids come or go; all the liquid may be there.
  const bool between = dt == 0.0;
  const VolumeFlux flux = volumeFlux(leavesAround(before, after, deficit, between, solidAfter.domain), before,
                                     after, velocity, solid, dt);
  const LeafTable& leaves = flux.leaves;
  std::vector<float> due(leaves.voxels(), 0.0f);
  std::vector<float> was = wetShares(before, solid, leaves);
  const std::vector<float> is = wetShares(after, solidAfter, leaves);
  std::vector<float> phi = sampleOn(leaves, after.constTree());
  // What is in a solid says how the liquid would go on there; where the solid leaves air behind, it was none.
  for (std::size_t at = 0; at < was.size(); ++at)
    if (flux.open[at] <= 0.0f && phi[at] >= 0.0f) was[at] = 0.0f;
  std::vector<float> shares = was;
  if (deficit != nullptr) {
    const std::vector<float> value = sampleOn(leaves, deficit->constTree());
    for (std::size_t at = 0; at < shares.size(); ++at) {
      if (flux.room[at] > kCarries) {
        shares[at] += value[at] / flux.room[at];
      } else {
        due[at] = value[at];
      }
    }
  }
  const SourceCells inSources = cellsOf(flows, leaves, solid, was);
  const CarriedShares flown = carried(flux, std::move(shares), inSources.filled);
  const float h = static_cast<float>(solid.voxelSize);
  const bool moved = between || !flux.swept.empty();
  std::vector<float> openAfter = moved ? openRoom(solidAfter, leaves) : flux.open;
  const std::vector<float> depth =
      moved ? sampleOn(leaves, solidAfter.phi->constTree()) : std::vector<float>();
  for (std::size_t at = 0; at < due.size(); ++at) {
    // What slivers have room for beyond their volume holds nothing.
    const float more = flux.room[at] - flux.open[at];
    due[at] += flux.room[at] * flown.share[at] - more * was[at] - openAfter[at] * is[at];
    if (!flown.swept.empty()) due[at] -= flown.swept[at];
    // Out of solids that have come over liquid it leads to their surface.
    if (openAfter[at] <= 0.0f) phi[at] = kFar * h - (moved ? depth[at] : 0.0f);
  }
  dropOutside(leaves, solid.domain, due);
  for (const FloatGrid* drain : flows.drains) forgive(leaves, *drain, h, due);
  // Where a source's velocity holds nothing can grow: what is owed goes around it.
  for (const std::size_t cell : inSources.given) {
    openAfter[cell] = 0.0f;
    phi[cell] = kFar * h;
  }
  gatherInLiquid(leaves, phi, kFar * h, due);
  spreadInLiquid(leaves, phi, openAfter, due);
  spreadPiles(leaves, solidAfter, openAfter, due);
  return toGrid(leaves, due, solid.voxelSize);
}

double totalDeficit(const FloatGrid& deficit) {
  double cells = 0.0;
  for (auto leaf = deficit.constTree().cbeginLeaf(); leaf; ++leaf)
    cells += std::accumulate(leaf->buffer().data(), leaf->buffer().data() + kLeafSize, 0.0);
  return cells * std::pow(deficit.voxelSize()[0], 3);
}

ShownLiquid shownAround(const MaskGrid& where, const FloatGrid& phi, const SolidField& solid) {
  MaskGrid::TreeType blocks;
  for (auto leaf = where.constTree().cbeginLeaf(); leaf; ++leaf) {
    if (leaf->isEmpty()) continue;
    for (int n = 0; n < 27; ++n)
      blocks.touchLeaf(leaf->origin().offsetBy(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1),
                                               kLeafDim * (n % 3 - 1)));
  }
  ShownLiquid shown;
  for (auto leaf = blocks.cbeginLeaf(); leaf; ++leaf) shown.blocks.push_back(leaf->origin());
  shown.shares.resize(shown.blocks.size());
  tbb::parallel_for(std::size_t{0}, shown.blocks.size(),
                    [&](std::size_t n) { liquidShares(phi, solid, shown.blocks[n], shown.shares[n]); });
  return shown;
}

void oweChange(FloatGrid& deficit, const ShownLiquid& before, const FloatGrid& phi, const SolidField& solid) {
  std::vector<FloatLeaf*> leaves(before.blocks.size());
  for (std::size_t n = 0; n < leaves.size(); ++n) leaves[n] = deficit.tree().touchLeaf(before.blocks[n]);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafShares after;
    liquidShares(phi, solid, before.blocks[n], after);
    leaves[n]->setValuesOn();
    for (int i = 0; i < kLeafSize; ++i)
      leaves[n]->setValueOnly(i, leaves[n]->getValue(i) + before.shares[n][i] - after[i]);
  });
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const float* values = leaves[n]->buffer().data();
    if (std::all_of(values, values + kLeafSize, [](float v) { return v == 0.0f; }))
      delete deficit.tree().stealNode<FloatLeaf>(before.blocks[n], 0.0f, false);
  }
}

Vec3d placeOfMost(const FloatGrid& deficit) {
  double most = -1.0;
  Coord cell(0);
  for (auto leaf = deficit.constTree().cbeginLeaf(); leaf; ++leaf) {
    const float* values = leaf->buffer().data();
    const double sum = std::abs(std::accumulate(values, values + kLeafSize, 0.0));
    if (sum <= most) continue;
    most = sum;
    const float* largest = std::max_element(values, values + kLeafSize,
                                            [](float a, float b) { return std::abs(a) < std::abs(b); });
    cell = leaf->offsetToGlobalCoord(static_cast<openvdb::Index>(largest - values));
  }
  return deficit.indexToWorld(cell);
}

FloatGrid::Ptr growthOf(const FloatGrid& deficit, double time) {
  require(time > 0.0, "growthOf: the time must be positive");
  const FloatGrid::Ptr growth = deficit.deepCopy();
  const float rate = static_cast<float>(1.0 / time);
  const auto leaves = leavesOf(growth->tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* values = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) values[i] = rate * std::clamp(values[i], -kMost, kMost);
  });
  return growth;
}

}  // namespace fluidtex::sim
