#include "sim/owed_volume.h"

#include "sim/leaf_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// No more than this share of a cell is given back at once.
constexpr float kMost = 0.5f;
// Rounds in which what is owed in the air falls towards the liquid, a cell each, and spreads in the liquid.
constexpr int kGatherRounds = 4, kSpreadRounds = 4;
// Of the difference to a neighbour: seven cells share evenly.
constexpr float kSpread = 1.0f / 7.0f;
// Less than this share of a cell is nothing.
constexpr float kNothing = 1e-6f;
// Solid, to what looks for the liquid.
constexpr float kFar = 1e6f;
// Cells with less room than this share do not make sub-steps shorter.
constexpr float kSliver = 0.25f;
// Of a cell's room, what may go through one of its faces in a sub-step (Weymouth and Yue 2010).
constexpr float kMostThroughFace = 0.5f;

constexpr int kSide = kLeafDim + 2;
constexpr int kStride[3] = {kSide * kSide, kSide, 1};
using Patch = std::array<float, kSide * kSide * kSide>;  // a leaf's values and those next to its faces

int patchIndex(int offset) {
  return ((offset >> 6) + 1) * kStride[0] + (((offset >> 3) & 7) + 1) * kStride[1] + (offset & 7) + 1;
}

// Values at the faces normal to an axis: the lower of each cell of a leaf, and the upper of its last layer.
// Along the axis first, then the other two in order.
using Faces = std::array<std::array<float, (kLeafDim + 1) * kLeafDim * kLeafDim>, 3>;

int faceIndex(int offset, int axis) {
  const int i = offset >> 6, j = (offset >> 3) & 7, k = offset & 7;
  return axis == 0 ? 64 * i + 8 * j + k : (axis == 1 ? 64 * j + 8 * i + k : 64 * k + 8 * i + j);
}
constexpr int kNextFace = kLeafDim * kLeafDim;

float netOutflow(const Faces& flux, int offset) {
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float* face = flux[axis].data() + faceIndex(offset, axis);
    sum += face[kNextFace] - face[0];
  }
  return sum;
}

// The leaves in which something can be owed, on flat arrays of 512 values a leaf.
struct Region {
  LeafTable leaves;
  std::vector<float> room;   // of each cell: open share of its volume, 0 in solids
  std::vector<Faces> flux;   // volume that would go through each face in a sub-step, in cells, upwards
  std::vector<float> swept;  // by solids that move into the cell, in a sub-step; empty where all are at rest
  std::vector<float> after;  // phi at the end, in cells
  std::vector<float> phi;    // half way there
  int steps = 1;
};

// For each leaf a patch of values; where there is no leaf, what `outside` makes of the value in the leaf.
template <class Outside>
void loadPatch(const LeafTable& leaves, const std::vector<float>& values, std::size_t leaf, Patch& patch,
               const Outside& outside) {
  const float* own = values.data() + leaf * kLeafSize;
  for (int i = 0; i < kLeafSize; ++i) patch[patchIndex(i)] = own[i];
  for (int direction = 0; direction < 6; ++direction) {
    const int axis = direction >> 1, up = direction & 1, shift = 6 - 3 * axis;
    const std::int32_t next = leaves.next[leaf][direction];
    const float* there = next < 0 ? nullptr : values.data() + std::size_t(next) * kLeafSize;
    for (int n = 0; n < kLeafDim * kLeafDim; ++n) {
      const int low = axis == 0 ? n : (axis == 1 ? (n >> 3) * 64 + (n & 7) : 8 * n);
      const int edge = low + (up != 0 ? 7 << shift : 0), beyond = low + (up != 0 ? 0 : 7 << shift);
      patch[patchIndex(edge) + (up != 0 ? kStride[axis] : -kStride[axis])] =
          there != nullptr ? there[beyond] : outside(own[edge]);
    }
  }
}

LeafTable leavesAround(const FloatGrid& before, const FloatGrid& after, const FloatGrid* owed,
                       const Coord& cells) {
  FloatTree topology(0.0f);
  const auto touch = [&](const Coord& origin) {
    for (int a = 0; a < 3; ++a) {
      if (origin[a] < 0 || origin[a] >= cells[a]) return;
    }
    topology.touchLeaf(origin);
  };
  for (auto leaf = before.constTree().cbeginLeaf(); leaf; ++leaf) touch(leaf->origin());
  for (auto leaf = after.constTree().cbeginLeaf(); leaf; ++leaf) touch(leaf->origin());
  if (owed != nullptr) {
    for (auto leaf = owed->constTree().cbeginLeaf(); leaf; ++leaf) {
      for (int n = 0; n < 27; ++n)
        touch(leaf->origin().offsetBy(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1),
                                      kLeafDim * (n % 3 - 1)));
    }
  }
  return makeLeafTable(topology);
}

float openShare(float solid, float h) {
  return std::clamp(0.5f + solid / h, 0.0f, 1.0f);
}

// The liquid's share of a cell's room.
float wetShare(float phi, float solid, float h) {
  const float open = openShare(solid, h), wet = std::clamp(0.5f - phi / h, 0.0f, 1.0f);
  if (open <= 0.0f) return phi < 0.0f ? 1.0f : 0.0f;
  return std::min(1.0f, wet / open);
}

// Fluxes, sub-steps and room.
Region makeRegion(const FloatGrid& before, const FloatGrid& after, const FloatGrid* owed,
                  const Velocity& velocity, const SolidField& solid, double dt) {
  Region region{leavesAround(before, after, owed, solid.cells), {}, {}, {}, {}, {}, 1};
  const LeafTable& leaves = region.leaves;
  const float h = static_cast<float>(solid.voxelSize), step = static_cast<float>(dt / solid.voxelSize);
  region.flux.resize(leaves.size());
  region.room.resize(leaves.voxels());
  region.after.resize(leaves.voxels());
  region.phi.resize(leaves.voxels());
  const bool moving = solid.speedU != nullptr;
  if (moving) region.swept.resize(leaves.voxels());
  std::vector<float> leaving(leaves.voxels()), most(leaves.size(), 0.0f);
  const FloatGrid* const open[3] = {solid.openU.get(), solid.openV.get(), solid.openW.get()};
  const FloatGrid* const push[3] = {solid.speedU.get(), solid.speedV.get(), solid.speedW.get()};
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves.origins[n];
    float solidScratch[kLeafSize], fromScratch[kLeafSize], toScratch[kLeafSize];
    const float* s = leafValues(solid.phi->constTree(), origin, solidScratch);
    const float* from = leafValues(before.constTree(), origin, fromScratch);
    const float* to = leafValues(after.constTree(), origin, toScratch);
    std::array<Patch, 3> share, pushed;
    Patch speed;
    for (int axis = 0; axis < 3; ++axis) {
      gather(open[axis]->constTree(), origin, 1, share[axis].data(), true);
      gather(velocity.component[axis]->constTree(), origin, 1, speed.data(), true);
      if (moving) gather(push[axis]->constTree(), origin, 1, pushed[axis].data(), true);
      auto& flux = region.flux[n][axis];
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = patchIndex(i), face = faceIndex(i, axis), above = at + kStride[axis];
        flux[face] = step * share[axis][at] * speed[at];
        flux[face + kNextFace] = step * share[axis][above] * speed[above];
      }
    }
    for (int i = 0; i < kLeafSize; ++i) {
      const std::size_t cell = n * kLeafSize + i;
      const int at = patchIndex(i);
      float out = 0.0f, anyOpen = 0.0f, swept = 0.0f, throughFace = 0.0f;
      for (int axis = 0; axis < 3; ++axis) {
        const float* flux = region.flux[n][axis].data() + faceIndex(i, axis);
        const int above = at + kStride[axis];
        out += std::max(0.0f, -flux[0]) + std::max(0.0f, flux[kNextFace]);
        throughFace = std::max({throughFace, -flux[0], flux[kNextFace]});
        anyOpen += share[axis][at] + share[axis][above];
        if (moving) {
          swept += step * ((1.0f - share[axis][at]) * pushed[axis][at] -
                           (1.0f - share[axis][above]) * pushed[axis][above]);
        }
      }
      region.after[cell] = to[i] / h;
      region.phi[cell] = 0.5f * (from[i] + to[i]) / h;
      if (anyOpen <= 0.0f) continue;
      if (moving) region.swept[cell] = swept;
      leaving[cell] = out + std::abs(swept);
      region.room[cell] = openShare(s[i], h);
      // Of slivers more may flow out than they hold: they get the room for it.
      if (region.room[cell] > kSliver)
        most[n] = std::max(
            {most[n], leaving[cell] / region.room[cell], throughFace / kMostThroughFace / region.room[cell]});
    }
  });
  const float largest = most.empty() ? 0.0f : *std::max_element(most.begin(), most.end());
  region.steps = std::max(1, static_cast<int>(std::ceil(largest)));
  const float part = 1.0f / static_cast<float>(region.steps);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (auto& axis : region.flux[n]) {
      for (float& flux : axis) flux *= part;
    }
    for (std::size_t cell = n * kLeafSize; cell < (n + 1) * kLeafSize; ++cell) {
      region.room[cell] = std::max(region.room[cell], part * leaving[cell]);
      if (moving) region.swept[cell] *= part;
    }
  });
  return region;
}

// Of each cell's room the share that is liquid.
std::vector<float> sharesOf(const FloatGrid& phi, const SolidField& solid, const LeafTable& leaves) {
  std::vector<float> shares(leaves.voxels());
  const float h = static_cast<float>(solid.voxelSize);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float phiScratch[kLeafSize], solidScratch[kLeafSize];
    const float* p = leafValues(phi.constTree(), leaves.origins[n], phiScratch);
    const float* s = leafValues(solid.phi->constTree(), leaves.origins[n], solidScratch);
    for (int i = 0; i < kLeafSize; ++i) shares[n * kLeafSize + i] = wetShare(p[i], s[i], h);
  });
  return shares;
}

// The room that solids leave after the step.
void moveRoom(Region& region, const SolidField& before, const SolidField& after) {
  const float h = static_cast<float>(before.voxelSize);
  tbb::parallel_for(std::size_t{0}, region.leaves.size(), [&](std::size_t n) {
    float wasScratch[kLeafSize], isScratch[kLeafSize];
    const float* was = leafValues(before.phi->constTree(), region.leaves.origins[n], wasScratch);
    const float* is = leafValues(after.phi->constTree(), region.leaves.origins[n], isScratch);
    for (int i = 0; i < kLeafSize; ++i) {
      float& room = region.room[n * kLeafSize + i];
      const float more = room > 0.0f ? room - openShare(was[i], h) : 0.0f;
      room = std::max(0.0f, openShare(is[i], h) + more);
    }
  });
}

// What goes through a face of the volume `flux` that leaves a cell, of whose `room` the share `wet` is
// liquid. rise: of phi over the face, outwards, in cells: by it the liquid lies at the face, or off it, or
// beside it. The weighted line interface calculation, Yokoi, "Efficient implementation of THINC scheme",
// 2007, sec. 2.3.
float leavingLiquid(float flux, float wet, float room, float rise) {
  if (wet <= 0.0f || wet >= 1.0f) return flux * wet;
  const float across = std::min(rise * rise, 1.0f);
  const float first = rise < 0.0f ? std::min(flux, wet * room) : std::max(0.0f, flux - (1.0f - wet) * room);
  return across * first + (1.0f - across) * flux * wet;
}

// Shares after the flow along one axis. full: which cells count as full in this sub-step; along one axis
// alone these swell or shrink, which is taken out again with the `last` axis, so that all is exact in sum:
// Weymouth and Yue, "Conservative volume-of-fluid method for free-surface simulations on Cartesian grids",
// 2010.
std::vector<float> carriedAlong(const Region& region, int axis, bool last, const std::vector<char>& full,
                                const std::vector<float>& shares) {
  std::vector<float> next(shares.size());
  tbb::parallel_for(std::size_t{0}, region.leaves.size(), [&](std::size_t n) {
    const auto asInside = [](float edge) { return edge; };
    Patch share, room, phi;
    loadPatch(region.leaves, shares, n, share, [](float edge) { return edge > 0.5f ? 1.0f : 0.0f; });
    loadPatch(region.leaves, region.room, n, room, asInside);
    loadPatch(region.leaves, region.phi, n, phi, asInside);
    for (int i = 0; i < kLeafSize; ++i) {
      const std::size_t cell = n * kLeafSize + i;
      const int at = patchIndex(i), low = at - kStride[axis], high = at + kStride[axis];
      next[cell] = 0.0f;
      if (room[at] <= 0.0f) continue;
      const float* flux = region.flux[n][axis].data() + faceIndex(i, axis);
      const float in = flux[0], out = flux[kNextFace];
      float gain = in > 0.0f ? leavingLiquid(in, share[low], room[low], phi[at] - phi[low])
                             : -leavingLiquid(-in, share[at], room[at], phi[low] - phi[at]);
      gain -= out > 0.0f ? leavingLiquid(out, share[at], room[at], phi[high] - phi[at])
                         : -leavingLiquid(-out, share[high], room[high], phi[at] - phi[high]);
      if (full[cell]) gain += out - in;
      if (last) {
        if (full[cell]) gain -= netOutflow(region.flux[n], i);
        // What solids sweep out, or make room for, is neither lost nor gained.
        if (!region.swept.empty()) gain += region.swept[cell] * share[at];
      }
      next[cell] = share[at] + gain / room[at];
    }
  });
  return next;
}

// Shares after one sub-step; the axes take turns at being first.
std::vector<float> carried(const Region& region, int step, std::vector<float> shares) {
  std::vector<char> full(shares.size());
  std::transform(shares.begin(), shares.end(), full.begin(), [](float share) { return share > 0.5f; });
  for (int n = 0; n < 3; ++n) shares = carriedAlong(region, (step + n) % 3, n == 2, full, shares);
  return shares;
}

// What is owed in cells of air falls towards the liquid, to the neighbours that are nearer to it.
void gatherInLiquid(const Region& region, std::vector<float>& owed) {
  const LeafTable& leaves = region.leaves;
  const auto none = [](float) { return kFar; };
  // One over the sum of differences to lower neighbours; 0 where nothing is given on.
  std::vector<float> rate(owed.size()), next(owed.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    Patch phi;
    loadPatch(leaves, region.after, n, phi, none);
    for (int i = 0; i < kLeafSize; ++i) {
      const int at = patchIndex(i);
      float drop = 0.0f;
      for (const int stride : kStride)
        drop += std::max(0.0f, phi[at] - phi[at - stride]) + std::max(0.0f, phi[at] - phi[at + stride]);
      rate[n * kLeafSize + i] = phi[at] >= 0.0f && drop > 0.0f ? 1.0f / drop : 0.0f;
    }
  });
  for (int round = 0; round < kGatherRounds; ++round) {
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      Patch phi, give, value;
      loadPatch(leaves, region.after, n, phi, none);
      loadPatch(leaves, rate, n, give, [](float) { return 0.0f; });
      loadPatch(leaves, owed, n, value, [](float) { return 0.0f; });
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = patchIndex(i);
        float sum = give[at] > 0.0f ? 0.0f : value[at];
        for (const int stride : kStride) {
          sum += std::max(0.0f, phi[at - stride] - phi[at]) * give[at - stride] * value[at - stride];
          sum += std::max(0.0f, phi[at + stride] - phi[at]) * give[at + stride] * value[at + stride];
        }
        next[n * kLeafSize + i] = sum;
      }
    });
    owed.swap(next);
  }
}

// Evens out what the cells of the liquid owe, as a share of their room.
void spreadInLiquid(const Region& region, std::vector<float>& owed) {
  const LeafTable& leaves = region.leaves;
  std::vector<float> wet(owed.size()), next(owed.size());
  for (std::size_t at = 0; at < owed.size(); ++at) wet[at] = region.after[at] < 0.0f ? region.room[at] : 0.0f;
  const auto none = [](float) { return 0.0f; };
  for (int round = 0; round < kSpreadRounds; ++round) {
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      Patch room{}, value{};
      loadPatch(leaves, wet, n, room, none);
      loadPatch(leaves, owed, n, value, none);
      Patch share;
      for (std::size_t at = 0; at < share.size(); ++at)
        share[at] = room[at] > 0.0f ? value[at] / room[at] : 0.0f;
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = patchIndex(i);
        float sum = 0.0f;
        for (const int stride : kStride) {
          sum += std::min(room[at], room[at - stride]) * (share[at - stride] - share[at]);
          sum += std::min(room[at], room[at + stride]) * (share[at + stride] - share[at]);
        }
        next[n * kLeafSize + i] = value[at] + kSpread * sum;
      }
    });
    owed.swap(next);
  }
}

// Nothing is owed within a cell of what is always full or always empty.
void forgive(const LeafTable& leaves, const FloatGrid& shape, float h, std::vector<float>& owed) {
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    float scratch[kLeafSize];
    const float* phi = leafValues(shape.constTree(), leaves.origins[n], scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      if (phi[i] < h) owed[n * kLeafSize + i] = 0.0f;
    }
  }
}

FloatGrid::Ptr toGrid(const LeafTable& leaves, const std::vector<float>& owed, double h) {
  auto grid = FloatGrid::create(0.0f);
  grid->setTransform(cellTransform(h));
  grid->setName("owed");
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    const float* values = owed.data() + n * kLeafSize;
    if (std::all_of(values, values + kLeafSize, [](float v) { return std::abs(v) < kNothing; })) continue;
    FloatLeaf* leaf = grid->tree().touchLeaf(leaves.origins[n]);
    leaf->setValuesOn();
    std::copy_n(values, kLeafSize, leaf->buffer().data());
  }
  return grid;
}

}  // namespace

FloatGrid::Ptr owedVolume(const FloatGrid& before, const FloatGrid& after, const FloatGrid* owed,
                          const Velocity& velocity, const SolidField& solid, const SolidField& solidAfter,
                          const RunningFlows& flows, double dt) {
  Region region = makeRegion(before, after, owed, velocity, solid, dt);
  const LeafTable& leaves = region.leaves;
  std::vector<float> due(leaves.voxels(), 0.0f), shares = sharesOf(before, solid, leaves);
  if (owed != nullptr) {
    const std::vector<float> was = sampleOn(leaves, owed->constTree());
    for (std::size_t at = 0; at < shares.size(); ++at) {
      if (region.room[at] > 0.0f) {
        shares[at] += was[at] / region.room[at];
      } else {
        due[at] = was[at];
      }
    }
  }
  for (int n = 0; n < region.steps; ++n) shares = carried(region, n, std::move(shares));

  for (std::size_t at = 0; at < due.size(); ++at) due[at] += region.room[at] * shares[at];
  if (!region.swept.empty()) {
    for (std::size_t at = 0; at < due.size(); ++at)
      due[at] -= static_cast<float>(region.steps) * region.swept[at] * shares[at];
    moveRoom(region, solid, solidAfter);
  }
  const std::vector<float> is = sharesOf(after, solidAfter, leaves);
  for (std::size_t at = 0; at < due.size(); ++at) due[at] -= region.room[at] * is[at];
  for (std::size_t at = 0; at < due.size(); ++at) {
    if (region.room[at] <= 0.0f) region.after[at] = kFar;
  }
  const float h = static_cast<float>(solid.voxelSize);
  for (const auto& running : flows.sources) forgive(leaves, *running.source->phi, h, due);
  for (const FloatGrid* drain : flows.drains) forgive(leaves, *drain, h, due);
  gatherInLiquid(region, due);
  spreadInLiquid(region, due);
  return toGrid(leaves, due, solid.voxelSize);
}

FloatGrid::Ptr growthOf(const FloatGrid& owed, double time) {
  const FloatGrid::Ptr growth = owed.deepCopy();
  const float rate = static_cast<float>(1.0 / time);
  const auto leaves = leavesOf(growth->tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* values = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) values[i] = rate * std::clamp(values[i], -kMost, kMost);
  });
  return growth;
}

}  // namespace fluidtex::sim
