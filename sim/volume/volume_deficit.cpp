#include "sim/volume/volume_deficit.h"

#include "sim/grid/leaf_patch.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/surface/cell_volume.h"
#include "sim/surface/level_set.h"
#include "sim/volume/shut_faces.h"
#include "sim/volume/volume_flux.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace fluidtex::sim {
namespace {

// Rounds in which the deficit in the air moves towards the liquid, a cell each.
constexpr int kGatherRounds = 4;
// Diffusion steps in the liquid. Fluxes know a smooth surface to some hundredths of a cell, too much here and
// too little there: diffusion evens this out before it moves the surface.
constexpr int kSpreadRounds = 10;
// Deficits below this share of a cell count as 0.
constexpr float kNothing = 1e-6f;
// The deficit of cells with less room than this share is not advected.
constexpr float kCarries = 1e-3f;
// Rounds in which the excess of full cells is passed on, a cell each.
constexpr int kPileRounds = 6;
// Distance to the liquid, in cells, that cells in solids get.
constexpr float kFar = 1e3f;

// The leaves that can hold a deficit. inside: include those of the liquid's interior.
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

// Calls body with the index at which each row of 8 voxels in z begins, in a leaf and in its patch.
template <class Body>
void forRows(const Body& body) {
  for (int row = 0; row < kLeafSize; row += kLeafDim) body(row, patchIndex(row));
}

// Whether liquid can flow from a cell to its neighbour along an axis. faces: open area fractions.
bool isWay(const LeafPatch& faces, const LeafPatch& room, int at, int axis, bool up) {
  const int stride = kPatchStride[axis];
  return faces[up ? at + stride : at] > 0.0f && room[up ? at + stride : at - stride] > 0.0f &&
         room[at] > 0.0f;
}

// Moves the deficit of air cells towards the liquid, to the neighbours that are nearer to it. phi: `far` or
// more in solids.
void gatherInLiquid(const LeafTable& leaves, const std::vector<float>& phi, float far, const ShutFaces& shut,
                    std::vector<float>& deficit) {
  const auto none = [far](float) { return 2.0f * far; };  // nothing moves where there is no leaf
  // One over the sum of differences to lower neighbours; 0 where nothing is passed on.
  std::vector<float> rate(deficit.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafPatch distance;
    loadPatch(leaves, phi, n, distance, none);
    const auto drop = [&](int at, int beside) { return std::max(0.0f, distance[at] - distance[beside]); };
    const auto rateOf = [&](int at, float drops) {
      return distance[at] >= 0.0f && drops > 0.0f ? 1.0f / drops : 0.0f;
    };
    for (int i = 0; i < kLeafSize; ++i) {
      const int at = patchIndex(i);
      float drops = 0.0f;
      for (const int stride : kPatchStride) drops += drop(at, at - stride) + drop(at, at + stride);
      rate[n * kLeafSize + i] = rateOf(at, drops);
    }
    forCellsBesideShut(
        shut, n, [&](int i, const auto& sum) { rate[n * kLeafSize + i] = rateOf(patchIndex(i), sum(drop)); });
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
      const auto kept = [&](int at) { return give[at] > 0.0f ? 0.0f : value[at]; };
      const auto arrives = [&](int at, int from) {
        return std::max(0.0f, distance[from] - distance[at]) * given[from];
      };
      forRows([&](int row, int first) {
        for (int k = 0; k < kLeafDim; ++k) {
          const int at = first + k;
          float sum = kept(at);
          for (const int stride : kPatchStride) {
            sum += arrives(at, at - stride);
            sum += arrives(at, at + stride);
          }
          next[n * kLeafSize + row + k] = sum;
        }
      });
      forCellsBesideShut(shut, n, [&](int i, const auto& sum) {
        next[n * kLeafSize + i] = kept(patchIndex(i)) + sum(arrives);
      });
    });
    deficit.swap(next);
  }
}

// Limits the deficit of a cell to its volume, either sign. Where drops land or liquid is compressed, the
// excess goes to the neighbours that it can reach, a cell further in each round.
void spreadPiles(const LeafTable& leaves, const SolidField& solid, const std::vector<float>& room,
                 std::vector<float>& deficit) {
  const auto excess = [](float due, float space) { return due - std::clamp(due, -space, space); };
  const auto& open = solid.open.component;
  for (int round = 0; round < kPileRounds; ++round) {
    // The part of each cell's excess that goes through each of its open sides.
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

// Share of the difference to each neighbour that a round moves. Most of these steps are unstable alone, but
// the ten together are stable, and diffuse as far as 33 stable ones: Alexiades, Amiez, Gremaud,
// "Super-time-stepping acceleration of explicit schemes for parabolic problems", 1996. Long and short steps
// alternate.
float spreadShare(int round) {
  constexpr double kStable = 1.0 / 6.0, kDamping = 0.03;
  const double angle = (2 * (3 * round % kSpreadRounds) + 1) * std::numbers::pi / (2 * kSpreadRounds);
  return static_cast<float>(kStable / ((kDamping - 1.0) * std::cos(angle) + 1.0 + kDamping));
}

// Diffuses the deficit of liquid cells, as a share of their room.
void spreadInLiquid(const LeafTable& leaves, const std::vector<float>& phi, const std::vector<float>& room,
                    const ShutFaces& shut, std::vector<float>& deficit) {
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
      const auto arrives = [&](int at, int from) {
        return std::min(space[at], space[from]) * (share[from] - share[at]);
      };
      forRows([&](int row, int first) {
        for (int k = 0; k < kLeafDim; ++k) {
          const int at = first + k;
          float sum = 0.0f;
          for (const int stride : kPatchStride) {
            sum += arrives(at, at - stride);
            sum += arrives(at, at + stride);
          }
          next[n * kLeafSize + row + k] = value[at] + part * sum;
        }
      });
      forCellsBesideShut(shut, n, [&](int i, const auto& sum) {
        next[n * kLeafSize + i] = value[patchIndex(i)] + part * sum(arrives);
      });
    });
    deficit.swap(next);
  }
}

// Drops the deficit beyond the sides of the domain.
void dropOutside(const LeafTable& leaves, const CoordBBox& domain, std::vector<float>& deficit) {
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    if (domain.isInside(CoordBBox::createCube(leaves.origins[n], kLeafDim))) continue;
    for (int i = 0; i < kLeafSize; ++i) {
      const Coord cell = leaves.origins[n].offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      if (!domain.isInside(cell)) deficit[n * kLeafSize + i] = 0.0f;
    }
  }
}

// Cells that sources refill, and those of them whose faces have a source's velocity.
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
        const std::size_t cell = n * kLeafSize + i;
        const bool given = flowing && distance[i] < near &&
                           isInSource(*running.source, solid, origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7));
        const bool holds = room[i] > kCarries && held[i] > 0.0f;
        if (!given && !holds) continue;
        // The source's own share; or the share before the step, where only the source's velocity leads out of
        // the cell.
        const float own = holds ? held[i] / room[i] : 0.0f;
        found[n].filled.push_back({cell, std::max(own, given ? was[cell] : 0.0f), !given});
        if (given && room[i] > 0.0f) found[n].given.push_back(cell);
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

// Removes liquid that is due within a cell of a drain, which is always empty. Liquid that the surface shows
// there in excess has not flowed there: without its negative deficit it would come out of nothing.
void drainDeficit(const LeafTable& leaves, const FloatGrid& shape, float h, std::vector<float>& deficit) {
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    float scratch[kLeafSize];
    const float* phi = leafValues(shape.constTree(), leaves.origins[n], scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      float& due = deficit[n * kLeafSize + i];
      if (phi[i] < h) due = std::min(due, 0.0f);
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

FloatGrid::Ptr volumeDeficit(const MovedLiquid& liquid, const Velocity& velocity, const MovedSolids& solids,
                             const RunningFlows& flows, double dt) {
  const auto& [before, after, deficit] = liquid;
  const auto& [solid, solidAfter] = solids;
  // Between two steps solids come or go, anywhere in the liquid.
  const bool between = dt == 0.0;
  const VolumeFlux flux = volumeFlux(leavesAround(before, after, deficit, between, solidAfter.domain), before,
                                     after, velocity, solid, dt);
  const LeafTable& leaves = flux.leaves;
  std::vector<float> due(leaves.voxels(), 0.0f);
  std::vector<float> was = wetShares(before, solid, leaves);
  const std::vector<float> is = wetShares(after, solidAfter, leaves);
  std::vector<float> phi = sampleOn(leaves, after.constTree());
  // phi in a solid is extrapolated; where the solid leaves air behind, there was no liquid.
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
    // The room of slivers beyond their volume is empty.
    const float more = flux.room[at] - flux.open[at];
    due[at] += flux.room[at] * flown.share[at] - more * was[at] - openAfter[at] * is[at];
    if (!flown.swept.empty()) due[at] -= flown.swept[at];
    // In solids that have covered liquid, leads the deficit to their surface.
    if (openAfter[at] <= 0.0f) phi[at] = kFar * h - (moved ? depth[at] : 0.0f);
  }
  dropOutside(leaves, solid.domain, due);
  for (const FloatGrid* drain : flows.drains) drainDeficit(leaves, *drain, h, due);
  // No expansion where a source's velocity is given: the deficit moves around these cells.
  for (const std::size_t cell : inSources.given) {
    openAfter[cell] = 0.0f;
    phi[cell] = kFar * h;
  }
  const ShutFaces shut = shutFaces(leaves, openAfter, solidAfter.open);
  gatherInLiquid(leaves, phi, kFar * h, shut, due);
  spreadInLiquid(leaves, phi, openAfter, shut, due);
  spreadPiles(leaves, solidAfter, openAfter, due);
  return toGrid(leaves, due, solid.voxelSize);
}

}  // namespace fluidtex::sim
