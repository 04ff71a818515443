#include "sim/volume/volume_flux.h"

#include "sim/grid/leaf_patch.h"
#include "sim/surface/cell_volume.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// Cells with less room than this share do not shorten the sub-steps.
constexpr float kSliver = 0.25f;
constexpr float kLeastRoom = 1e-12f;
// Room beyond an open side of the domain: so much that what flows in or out changes no share.
constexpr float kBeyond = 1e6f;
// Fluxes below this share of a cell count as 0.
constexpr float kLeastFlow = 1e-6f;

// Strides from a face to those of the next row of cells along x and y.
constexpr int kFaceRowX[3] = {64, 72, 72}, kFaceRowY[3] = {8, 8, 9};

// The lower face of the cell at an offset of the leaf.
int faceIndex(int offset, int axis) {
  return kFaceRowX[axis] * (offset >> 6) + kFaceRowY[axis] * ((offset >> 3) & 7) + (offset & 7);
}

float netOutflow(const LeafFaces& flux, int offset) {
  float sum = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float* face = flux[axis].data() + faceIndex(offset, axis);
    sum += face[kLeafStride[axis]] - face[0];
  }
  return sum;
}

// One side of a face: liquid share of the room, the room, and phi in cells.
struct Beside {
  float share, room, phi;
};

// Liquid volume that passes a face upwards with the total volume `flux`. The slope of phi decides whether the
// liquid lies at the face, away from it, or beside it. Weighted line interface calculation: Yokoi, "Efficient
// implementation of THINC scheme", 2007, sec. 2.3. There the part beside the face is first-order and smooths
// slopes away; here it follows the slope of phi.
inline float liquidThrough(float flux, const Beside& below, const Beside& above) {
  const bool up = flux > 0.0f;
  const float volume = up ? flux : -flux, share = up ? below.share : above.share,
              room = up ? below.room : above.room;
  const float rise = up ? above.phi - below.phi : below.phi - above.phi;
  const float across = std::min(rise * rise, 1.0f), even = volume * share;
  const float atFace = std::min(volume, share * room),
              offFace = std::max(0.0f, volume - (room - share * room));
  // A cell without room has no open face, and nothing flows out of it.
  const float swept = volume / std::max(room, kLeastRoom);
  const float beside = std::clamp(even - 0.5f * volume * (1.0f - swept) * rise, offFace, atFace);
  const float mixed = beside + across * ((rise < 0.0f ? atFace : offFace) - beside);
  const float liquid = share > 0.0f && share < 1.0f ? mixed : even;
  return up ? liquid : -liquid;
}

// Divides a whole step's fluxes into sub-steps. leaving: outflow of each cell; most: largest flux through a
// face of each leaf's cells, over their room.
void divide(VolumeFlux& flux, const std::vector<float>& leaving, const std::vector<float>& most) {
  const float largest = most.empty() ? 0.0f : *std::max_element(most.begin(), most.end());
  flux.steps = std::max(1, static_cast<int>(std::ceil(largest)));
  const float part = 1.0f / static_cast<float>(flux.steps);
  tbb::parallel_for(std::size_t{0}, flux.leaves.size(), [&](std::size_t n) {
    for (auto& axis : flux.flux[n]) {
      for (float& volume : axis) volume *= part;
    }
    for (std::size_t cell = n * kLeafSize; cell < (n + 1) * kLeafSize; ++cell) {
      // More may flow out of slivers than they hold: their room is enlarged.
      float& room = flux.room[cell];
      if (room <= kSliver) room = std::max(room, part * leaving[cell]);
      if (!flux.swept.empty()) flux.swept[cell] *= part;
    }
  });
}

// Shares after the flow along one axis. full: cells that count as full in this sub-step. The flow along one
// axis alone expands or compresses them; the `last` axis corrects that, so that the sum is exact: Weymouth
// and Yue, "Conservative volume-of-fluid method for free-surface simulations on Cartesian grids", 2010.
template <int kAxis>
std::vector<float> carriedAlong(const VolumeFlux& all, bool last, const std::vector<char>& full,
                                const std::vector<float>& shares, std::vector<float>& pressed) {
  constexpr int kStride = kPatchStride[kAxis];
  std::vector<float> next(shares.size());
  tbb::parallel_for(std::size_t{0}, all.leaves.size(), [&](std::size_t n) {
    const auto asInside = [](float edge) { return edge; };
    LeafPatch share{}, room, phi, liquid;  // liquid: through the lower face of each cell
    loadPatchAlong<kAxis>(all.leaves, shares, n, share, [](float edge) { return edge > 0.5f ? 1.0f : 0.0f; });
    if (std::none_of(share.begin(), share.end(), [](float s) { return s != 0.0f; })) return;
    loadPatchAlong<kAxis>(all.leaves, all.room, n, room, asInside);
    loadPatchAlong<kAxis>(all.leaves, all.phi, n, phi, asInside);
    const float* flux = all.flux[n][kAxis].data();
    for (int i = 0; i < kLeafDim + (kAxis == 0 ? 1 : 0); ++i) {
      for (int j = 0; j < kLeafDim + (kAxis == 1 ? 1 : 0); ++j) {
        const int row = patchIndex(0) + i * kPatchStride[0] + j * kPatchStride[1];
        const float* through = flux + i * kFaceRowX[kAxis] + j * kFaceRowY[kAxis];
        for (int k = 0; k < kLeafDim + (kAxis == 2 ? 1 : 0); ++k) {
          const int high = row + k, low = high - kStride;
          liquid[high] = liquidThrough(through[k], {share[low], room[low], phi[low]},
                                       {share[high], room[high], phi[high]});
        }
      }
    }
    const float* swept = last && !all.swept.empty() ? all.swept.data() + n * kLeafSize : nullptr;
    for (int row = 0; row < kLeafSize; row += kLeafDim) {
      const float* through = flux + faceIndex(row, kAxis);
      const char* isFull = full.data() + n * kLeafSize + row;
      float* to = next.data() + n * kLeafSize + row;
      float gain[kLeafDim], net[kLeafDim];
      for (int k = 0; k < kLeafDim; ++k) net[k] = last ? netOutflow(all.flux[n], row + k) : 0.0f;
      for (int k = 0; k < kLeafDim; ++k) {
        const int at = patchIndex(row) + k;
        const float expands = through[k + kLeafStride[kAxis]] - through[k];
        gain[k] = liquid[at] - liquid[at + kStride];
        gain[k] = isFull[k] != 0 ? gain[k] + expands - net[k] : gain[k];
      }
      // Volume that solids sweep out or make room for is neither lost nor gained.
      for (int k = 0; swept != nullptr && k < kLeafDim; ++k) {
        const float more = swept[row + k] * share[patchIndex(row) + k];
        gain[k] += more;
        pressed[n * kLeafSize + row + k] += more;
      }
      for (int k = 0; k < kLeafDim; ++k) {
        const int at = patchIndex(row) + k;
        const float space = room[at] > 0.0f ? room[at] : 1.0f, moved = share[at] + gain[k] / space;
        to[k] = room[at] > 0.0f ? moved : 0.0f;
      }
    }
  });
  return next;
}

}  // namespace

VolumeFlux volumeFlux(LeafTable table, const FloatGrid& before, const FloatGrid& after,
                      const Velocity& velocity, const SolidField& solid, double dt) {
  VolumeFlux result{std::move(table), {}, {}, {}, {}, {}, 1};
  const LeafTable& leaves = result.leaves;
  const float h = static_cast<float>(solid.voxelSize), step = static_cast<float>(dt / solid.voxelSize);
  result.flux.resize(leaves.size());
  result.open = result.room = openRoom(solid, leaves);
  result.phi.resize(leaves.voxels());
  const bool moving = bool(solid.speed);
  if (moving) result.swept.resize(leaves.voxels());
  std::vector<float> leaving(leaves.voxels()), most(leaves.size(), 0.0f);
  const auto& open = solid.open.component;
  const auto& push = solid.speed.component;
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = leaves.origins[n];
    float fromScratch[kLeafSize], toScratch[kLeafSize];
    const float* from = leafValues(before.constTree(), origin, fromScratch);
    const float* to = leafValues(after.constTree(), origin, toScratch);
    std::array<LeafPatch, 3> share, pushed;
    LeafPatch speed;
    for (int axis = 0; axis < 3; ++axis) {
      gather(open[axis]->constTree(), origin, 1, share[axis].data(), true);
      gather(velocity.component[axis]->constTree(), origin, 1, speed.data(), true);
      if (moving) gather(push[axis]->constTree(), origin, 1, pushed[axis].data(), true);
      auto& flux = result.flux[n][axis];
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = patchIndex(i), face = faceIndex(i, axis), above = at + kPatchStride[axis];
        flux[face] = step * share[axis][at] * speed[at];
        flux[face + kLeafStride[axis]] = step * share[axis][above] * speed[above];
      }
    }
    const bool within = solid.domain.isInside(openvdb::CoordBBox::createCube(origin, kLeafDim));
    for (int i = 0; i < kLeafSize; ++i) {
      const std::size_t cell = n * kLeafSize + i;
      const int at = patchIndex(i);
      const bool outside = !within && !solid.domain.isInside(origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7));
      if (outside) result.open[cell] = 0.0f;
      float out = 0.0f, in = 0.0f, swept = 0.0f, throughFace = 0.0f;
      for (int axis = 0; axis < 3; ++axis) {
        const float* flux = result.flux[n][axis].data() + faceIndex(i, axis);
        const int above = at + kPatchStride[axis];
        out += std::max(0.0f, -flux[0]) + std::max(0.0f, flux[kLeafStride[axis]]);
        in += std::max(0.0f, flux[0]) + std::max(0.0f, -flux[kLeafStride[axis]]);
        throughFace = std::max({throughFace, -flux[0], flux[kLeafStride[axis]]});
        if (moving) {
          swept += step * ((1.0f - share[axis][at]) * pushed[axis][at] -
                           (1.0f - share[axis][above]) * pushed[axis][above]);
        }
      }
      result.phi[cell] = 0.5f * (from[i] + to[i]) / h;
      if (result.open[cell] <= 0.0f) {
        // A corner of the cell may be open all the same; what passes there needs room.
        const float through = std::max(out, in);
        if (outside) {
          result.room[cell] = through > kLeastFlow ? kBeyond : 0.0f;
        } else if (through > kLeastFlow) {
          leaving[cell] = through;
        }
        continue;
      }
      if (moving) result.swept[cell] = swept;
      leaving[cell] = out + std::abs(swept);
      if (result.room[cell] > kSliver) most[n] = std::max(most[n], throughFace / result.room[cell]);
    }
  });
  divide(result, leaving, most);
  return result;
}

std::vector<float> wetShares(const FloatGrid& phi, const SolidField& solid, const LeafTable& leaves) {
  std::vector<float> shares(leaves.voxels());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafShares liquid, open;
    liquidShares(phi, solid, leaves.origins[n], liquid);
    openShares(solid, leaves.origins[n], open);
    float scratch[kLeafSize];
    const float* p = leafValues(phi.constTree(), leaves.origins[n], scratch);
    for (int i = 0; i < kLeafSize; ++i) {
      const float inSolid = p[i] < 0.0f ? 1.0f : 0.0f;  // of cells without an open part
      shares[n * kLeafSize + i] = open[i] > 0.0f ? liquid[i] / open[i] : inSolid;
    }
  });
  return shares;
}

std::vector<float> openRoom(const SolidField& solid, const LeafTable& leaves) {
  std::vector<float> room(leaves.voxels());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    LeafShares open;
    openShares(solid, leaves.origins[n], open);
    std::copy(open.begin(), open.end(), room.begin() + static_cast<std::ptrdiff_t>(n * kLeafSize));
  });
  return room;
}

CarriedShares carried(const VolumeFlux& flux, std::vector<float> shares,
                      const std::vector<FilledCell>& sources) {
  std::vector<char> full(shares.size());
  std::vector<float> pressed(flux.swept.size(), 0.0f);
  const auto fill = [&] {
    for (const auto& [cell, share, atLeast] : sources)
      shares[cell] = atLeast ? std::max(shares[cell], share) : share;
  };
  fill();
  for (int step = 0; step < flux.steps; ++step) {
    std::transform(shares.begin(), shares.end(), full.begin(), [](float share) { return share > 0.5f; });
    // The axes alternate in being first.
    for (int n = 0; n < 3; ++n) {
      const int axis = (step + n) % 3;
      const auto along = axis == 0 ? carriedAlong<0> : axis == 1 ? carriedAlong<1> : carriedAlong<2>;
      shares = along(flux, n == 2, full, shares, pressed);
    }
    fill();
  }
  return {std::move(shares), std::move(pressed)};
}

}  // namespace fluidtex::sim
