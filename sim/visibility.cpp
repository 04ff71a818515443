#include "sim/visibility.h"

#include "sim/level_set.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <set>

namespace fluidtex::sim {
namespace {

// Walls thicker than this many cells are none: stencils end within them.
constexpr int kThickest = 6;
// What is known around a block: the cells that are asked about, the way from one in the solid to the open,
// and from there on.
constexpr int kHalo = 8, kSide = kLeafDim + 2 * kHalo;
constexpr int kStride[3] = {kSide * kSide, kSide, 1};
// From the open cell that looks.
constexpr int kFar = 5, kBox = 2 * kFar + 1;
constexpr int kBoxStride[3] = {kBox * kBox, kBox, 1};
constexpr int kBoxMiddle = kFar * (kBoxStride[0] + kBoxStride[1] + kBoxStride[2]);

struct Surroundings {
  std::vector<float> distance;                 // in cells
  std::array<std::vector<float>, 3> openness;  // of the lower faces

  Surroundings(const FloatGrid& solidPhi, const std::array<const FloatGrid*, 3>& open, const Coord& origin)
      : distance(kSide * kSide * kSide) {
    gather(solidPhi.constTree(), origin, kHalo, distance.data());
    const float scale = static_cast<float>(1.0 / solidPhi.voxelSize()[0]);
    for (float& d : distance) d *= scale;
    for (int a = 0; a < 3; ++a) {
      openness[a].resize(distance.size());
      gather(open[a]->constTree(), origin, kHalo, openness[a].data());
    }
  }

  bool isOpen(int cell) const { return distance[cell] >= -kDeepInSolid; }
  // Whether a way leads from a cell to the next one along an axis.
  bool leadsUp(int cell, int axis) const {
    const int next = cell + kStride[axis];
    return isOpen(cell) && isOpen(next) && openness[axis][next] > 0.0f;
  }

  // Whether a row of cells leaves the open and comes back to it within kThickest cells.
  bool crossesThinWall(int first, int axis) const {
    int last = -kSide;  // the last open cell
    bool left = false;  // since then
    for (int i = 0; i < kSide; ++i) {
      const int cell = first + i * kStride[axis];
      if (!isOpen(cell)) {
        left = true;
        continue;
      }
      if (i > 0 && last == i - 1 && openness[axis][cell] <= 0.0f) left = true;
      if (left && i - last <= kThickest) return true;
      last = i;
      left = false;
    }
    return false;
  }
  bool hasThinWall() const {
    for (int axis = 0; axis < 3; ++axis) {
      const int p = kStride[(axis + 1) % 3], q = kStride[(axis + 2) % 3];
      for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j)
          if (crossesThinWall(i * p + j * q, axis)) return true;
    }
    return false;
  }

  // The cell in the open from which a cell gets its values: downhill in depth. Itself in the open; -1 for
  // none within the layers that hold values.
  int sourceOf(int cell) const {
    for (int step = 0; !isOpen(cell); ++step) {
      if (step > static_cast<int>(kSolidLayers) + 1) return -1;
      int best = cell;
      for (int a = 0; a < 3; ++a)
        for (const int next : {cell - kStride[a], cell + kStride[a]})
          if (distance[next] > distance[best]) best = next;
      if (best == cell) return -1;
      cell = best;
    }
    return cell;
  }
};

// Which cells of the box around an open one a way leads to that turns back along no axis.
void walk(const Surroundings& around, int from, std::array<bool, kBox * kBox * kBox>& reached) {
  reached.fill(false);
  reached[kBoxMiddle] = true;
  const auto visit = [&](int i, int j, int k) {
    const int offset[3] = {i, j, k};
    const int cell = from + i * kStride[0] + j * kStride[1] + k * kStride[2];
    const int at = kBoxMiddle + i * kBoxStride[0] + j * kBoxStride[1] + k * kBoxStride[2];
    for (int a = 0; a < 3 && !reached[at]; ++a) {
      if (offset[a] == 0) continue;
      const int back = offset[a] > 0 ? -1 : 1;
      reached[at] =
          reached[at + back * kBoxStride[a]] && around.leadsUp(back < 0 ? cell - kStride[a] : cell, a);
    }
  };
  // Outwards in each octant; their common planes come twice, which does no harm.
  for (int octant = 0; octant < 8; ++octant) {
    const int si = (octant & 4) != 0 ? -1 : 1, sj = (octant & 2) != 0 ? -1 : 1,
              sk = (octant & 1) != 0 ? -1 : 1;
    for (int i = 0; i <= kFar; ++i)
      for (int j = 0; j <= kFar; ++j)
        for (int k = 0; k <= kFar; ++k)
          if (i + j + k > 0) visit(si * i, sj * j, sk * k);
  }
}

std::unique_ptr<Visibility::Leaf> look(const Surroundings& around) {
  auto leaf = std::make_unique<Visibility::Leaf>();
  bool any = false;
  std::vector<int> source(around.distance.size(), -2);  // -2: not asked yet
  const auto sourceOf = [&](int cell) {
    if (source[cell] == -2) source[cell] = around.sourceOf(cell);
    return source[cell];
  };
  std::array<bool, kBox * kBox * kBox> reached;
  constexpr int kReach = VisibleCells::kReach;
  for (int c = 0; c < kLeafSize; ++c) {
    const int i = (c >> 6) + kHalo, j = ((c >> 3) & 7) + kHalo, k = (c & 7) + kHalo;
    const int cell = i * kStride[0] + j * kStride[1] + k * kStride[2];
    const int from = sourceOf(cell);
    if (from < 0) continue;
    const int fromAt[3] = {from / kStride[0], from / kSide % kSide, from % kSide};
    if (std::any_of(fromAt, fromAt + 3, [](int x) { return x < kFar || x >= kSide - kFar; })) continue;
    walk(around, from, reached);
    VisibleCells& visible = (*leaf)[c];
    for (int di = -kReach; di <= kReach; ++di) {
      for (int dj = -kReach; dj <= kReach; ++dj) {
        for (int dk = -kReach; dk <= kReach; ++dk) {
          const int to = sourceOf(cell + di * kStride[0] + dj * kStride[1] + dk * kStride[2]);
          if (to < 0) continue;  // nobody's
          const int way[3] = {to / kStride[0] - fromAt[0], to / kSide % kSide - fromAt[1],
                              to % kSide - fromAt[2]};
          const bool near = std::all_of(way, way + 3, [](int w) { return std::abs(w) <= kFar; });
          if (near &&
              reached[kBoxMiddle + way[0] * kBoxStride[0] + way[1] * kBoxStride[1] + way[2] * kBoxStride[2]])
            continue;
          visible.hide(VisibleCells::kMiddle + di * VisibleCells::kStride[0] + dj * VisibleCells::kStride[1] +
                       dk * VisibleCells::kStride[2]);
          any = true;
        }
      }
    }
  }
  return any ? std::move(leaf) : nullptr;
}

}  // namespace

void goOnBehind(Stencil& values, const VisibleCells& visible) {
  if (visible.seesAll()) return;
  constexpr int kReach = VisibleCells::kReach;
  std::array<bool, VisibleCells::kCount> known;
  for (int at = 0; at < VisibleCells::kCount; ++at) known[at] = visible.sees(at);
  // Outwards from the middle, so that what goes on is what lies there.
  for (int ring = 1; ring <= 3 * kReach; ++ring) {
    for (int i = -kReach; i <= kReach; ++i) {
      for (int j = -kReach; j <= kReach; ++j) {
        const int k = ring - std::abs(i) - std::abs(j);
        if (k < 0 || k > kReach) continue;
        for (const int up : {-1, 1}) {
          if (k == 0 && up > 0) continue;
          const int offset[3] = {i, j, up * k};
          int at = VisibleCells::kMiddle;
          for (int a = 0; a < 3; ++a) at += offset[a] * VisibleCells::kStride[a];
          if (known[at]) continue;
          float sum = 0.0f;
          int count = 0;
          for (int a = 0; a < 3; ++a) {
            if (offset[a] == 0) continue;
            const int inwards = offset[a] > 0 ? -VisibleCells::kStride[a] : VisibleCells::kStride[a];
            const float near = values[at + inwards];
            // Two steps inwards may lead past the middle, but never out of the stencil.
            const float further = known[at + 2 * inwards] ? 2.0f * near - values[at + 2 * inwards] : near;
            sum += (further < 0.0f) == (near < 0.0f) ? further : near;
            ++count;
          }
          values[at] = sum / static_cast<float>(count);
          known[at] = true;
        }
      }
    }
  }
}

const VisibleCells* Visibility::around(const Coord& cell) const {
  constexpr int kMask = ~(kLeafDim - 1);
  const Leaf* there = leaf(Coord(cell.x() & kMask, cell.y() & kMask, cell.z() & kMask));
  if (there == nullptr) return nullptr;
  const VisibleCells& visible = (*there)[((cell.x() & 7) << 6) + ((cell.y() & 7) << 3) + (cell.z() & 7)];
  return visible.seesAll() ? nullptr : &visible;
}

bool Visibility::touches(const openvdb::CoordBBox& box) const {
  constexpr int kMask = ~(kLeafDim - 1);
  for (int i = box.min().x() & kMask; i <= box.max().x(); i += kLeafDim)
    for (int j = box.min().y() & kMask; j <= box.max().y(); j += kLeafDim)
      for (int k = box.min().z() & kMask; k <= box.max().z(); k += kLeafDim)
        if (leaf(Coord(i, j, k)) != nullptr) return true;
  return false;
}

std::shared_ptr<const Visibility> visibilityOf(const FloatGrid& solidPhi,
                                               const std::array<const FloatGrid*, 3>& open) {
  // Blocks that hold a solid's surface, and those around them.
  std::set<Coord> origins;
  for (auto leaf = solidPhi.constTree().cbeginLeaf(); leaf; ++leaf) {
    for (int n = 0; n < 27; ++n) {
      origins.insert(leaf->origin() +
                     Coord(kLeafDim * (n / 9 - 1), kLeafDim * (n / 3 % 3 - 1), kLeafDim * (n % 3 - 1)));
    }
  }
  const std::vector<Coord> all(origins.begin(), origins.end());
  std::vector<std::unique_ptr<Visibility::Leaf>> leaves(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t n) {
    const Surroundings around(solidPhi, open, all[n]);
    if (around.hasThinWall()) leaves[n] = look(around);
  });
  auto result = std::make_shared<Visibility>();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (leaves[n] != nullptr) result->add(all[n], std::move(leaves[n]));
  return result->empty() ? nullptr : result;
}

}  // namespace fluidtex::sim
