#include "sim/solids/visibility.h"

#include "sim/solids/solid_layers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace fluidtex::sim {
namespace {

// Walls thicker than this many cells do not count as thin: stencils end within them.
constexpr int kThickest = 5;
// Cells around a block that are needed: those asked about, the path from one in the solid to the outside, and
// on from there.
constexpr int kHalo = 8, kSide = kLeafDim + 2 * kHalo;
constexpr int kStride[3] = {kSide * kSide, kSide, 1}, kLastCell = kSide * kSide * kSide - 1;
// Farther from solids than this, in cells, a distance may be one that was never set.
constexpr float kSurelyKnown = 2.9f;
// Half width and width of the box around the cell outside solids that is looked from, in cells.
constexpr int kFar = 5, kBox = 2 * kFar + 1;
constexpr int kBoxStride[3] = {kBox * kBox, kBox, 1};
constexpr int kBoxMiddle = kFar * (kBoxStride[0] + kBoxStride[1] + kBoxStride[2]);

// A cell of a stencil, and the strides that lead from it towards the middle, one an axis.
struct Outwards {
  int at = 0, axes = 0;
  int inwards[3] = {};
};

// All cells of a stencil but the middle, those that fewer faces part from it first.
constexpr auto kOutwards = [] {
  constexpr int kReach = VisibleCells::kReach;
  std::array<Outwards, VisibleCells::kCount - 1> cells{};
  std::size_t count = 0;
  for (int ring = 1; ring <= 3 * kReach; ++ring) {
    for (int at = 0; at < VisibleCells::kCount; ++at) {
      Outwards cell{at};
      int rest = at, steps = 0;
      for (const int stride : VisibleCells::kStride) {
        const int away = rest / stride - kReach;
        rest %= stride;
        steps += away < 0 ? -away : away;
        if (away != 0) cell.inwards[cell.axes++] = away < 0 ? stride : -stride;
      }
      if (steps == ring) cells[count++] = cell;
    }
  }
  return cells;
}();

struct Surroundings {
  std::vector<float> distance;                 // in cells
  std::array<std::vector<float>, 3> openness;  // of the lower faces

  Surroundings(const FloatGrid& solidPhi, const FaceGrids& open, const Coord& origin)
      : distance(kSide * kSide * kSide) {
    gather(solidPhi.constTree(), origin, kHalo, distance.data());
    const float scale = static_cast<float>(1.0 / solidPhi.voxelSize()[0]);
    for (float& d : distance) d *= scale;
    for (int a = 0; a < 3; ++a) {
      openness[a].resize(distance.size());
      gather(open[a].constTree(), origin, kHalo, openness[a].data());
    }
  }

  // A surface is nearer than half a cell's diagonal to some cell centre.
  bool anySolid() const {
    return std::any_of(distance.begin(), distance.end(), [](float d) { return d < 0.87f; });
  }
  // Outside solids. Beyond the known distances cells count as outside, but their faces as closed.
  bool isOpen(int cell) const {
    if (distance[cell] < -kDeepInSolid) return false;
    if (distance[cell] < kSurelyKnown) return true;
    for (int a = 0; a < 3; ++a)
      if (openness[a][cell] > 0.0f || openness[a][std::min(cell + kStride[a], kLastCell)] > 0.0f) return true;
    return false;
  }
  // Whether a path leads from a cell to the next one along an axis.
  bool leadsUp(int cell, int axis) const {
    const int next = cell + kStride[axis];
    return isOpen(cell) && isOpen(next) && openness[axis][next] > 0.0f;
  }

  // Marks the cells at which a row of cells enters a solid and leaves it, at most kThickest apart. True if
  // any.
  bool markThinWalls(int first, int axis, std::vector<char>& marks) const {
    int last = -kSide;  // the last open cell
    bool left = false, any = false;
    for (int i = 0; i < kSide; ++i) {
      const int cell = first + i * kStride[axis];
      if (!isOpen(cell)) {
        left = true;
        continue;
      }
      if (last == i - 1 && openness[axis][cell] <= 0.0f) left = true;
      if (left && i - last <= kThickest) {
        any = true;
        for (int n = last; n <= i; ++n) marks[first + n * kStride[axis]] = 1;
      }
      last = i;
      left = false;
    }
    return any;
  }
  // Marks the cells beside thin walls and in them; empty where there are none.
  std::vector<char> besideThinWalls() const {
    std::vector<char> marks(distance.size(), 0);
    bool any = false;
    for (int axis = 0; axis < 3; ++axis) {
      const int p = kStride[(axis + 1) % 3], q = kStride[(axis + 2) % 3];
      for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) any = markThinWalls(i * p + j * q, axis, marks) || any;
    }
    if (!any) return {};
    // Grown by the reach of stencils, one axis after the other.
    for (const int stride : kStride) {
      const std::vector<char> before = marks;
      for (std::size_t at = 0; at < marks.size(); ++at) {
        if (before[at] == 0) continue;
        for (int n = -VisibleCells::kReach; n <= VisibleCells::kReach; ++n) {
          const auto there = static_cast<std::ptrdiff_t>(at) + n * stride;
          if (there >= 0 && there < static_cast<std::ptrdiff_t>(marks.size())) marks[there] = 1;
        }
      }
    }
    return marks;
  }

  // The cell outside solids from which a cell is extrapolated: through open faces where there are any, else
  // along decreasing depth. In a corner of thin walls the other side may be nearer than the cell's own. The
  // cell itself outside solids; -1 where there is none within the layers that hold values.
  int sourceOf(int cell) const {
    int before = -1;
    for (int step = 0; !isOpen(cell); ++step) {
      if (step > static_cast<int>(kSolidLayers) + 1) return -1;
      int best = -1;
      const auto look = [&](bool through) {
        for (int a = 0; a < 3; ++a) {
          for (const int next : {cell - kStride[a], cell + kStride[a]}) {
            const bool leads = through ? next != before && openness[a][std::max(cell, next)] > 0.0f
                                       : distance[next] > distance[cell];
            if (leads && (best < 0 || distance[next] > distance[best])) best = next;
          }
        }
      };
      look(true);
      if (best < 0) look(false);
      if (best < 0) return -1;
      before = cell;
      cell = best;
    }
    return cell;
  }
};

using Reached = std::array<bool, kBox * kBox * kBox>;

// Marks the cells, up to `far` from one outside solids, to which a path leads that turns back along no axis.
void walk(const Surroundings& around, int from, int far, Reached& reached) {
  reached[kBoxMiddle] = true;
  // A cell is reached from those one step nearer along each axis; one octant at a time, the upper one where a
  // sign is 1.
  const auto fill = [&](int si, int sj, int sk) {
    const int out[3] = {si * kStride[0], sj * kStride[1], sk * kStride[2]};
    const int boxOut[3] = {si * kBoxStride[0], sj * kBoxStride[1], sk * kBoxStride[2]};
    const int sign[3] = {si, sj, sk};
    for (int i = 0; i <= far; ++i) {
      for (int j = 0; j <= far; ++j) {
        for (int k = 0; k <= far; ++k) {
          const int steps[3] = {i, j, k};
          const int cell = from + i * out[0] + j * out[1] + k * out[2];
          const int at = kBoxMiddle + i * boxOut[0] + j * boxOut[1] + k * boxOut[2];
          bool any = i + j + k == 0;
          for (int a = 0; a < 3 && !any; ++a) {
            any = steps[a] > 0 && reached[at - boxOut[a]] &&
                  around.leadsUp(sign[a] > 0 ? cell - kStride[a] : cell, a);
          }
          reached[at] = any;
        }
      }
    }
  };
  for (int octant = 0; octant < 8; ++octant)
    fill((octant & 4) != 0 ? -1 : 1, (octant & 2) != 0 ? -1 : 1, (octant & 1) != 0 ? -1 : 1);
}

std::unique_ptr<Visibility::Leaf> look(const Surroundings& around) {
  const std::vector<char> asked = around.besideThinWalls();
  if (asked.empty()) return nullptr;
  auto leaf = std::make_unique<Visibility::Leaf>();
  bool any = false;
  std::vector<int> source(around.distance.size(), -2);  // -2: not asked yet
  const auto sourceOf = [&](int cell) {
    if (source[cell] == -2) source[cell] = around.sourceOf(cell);
    return source[cell];
  };
  Reached reached;
  constexpr int kReach = VisibleCells::kReach;
  for (int c = 0; c < kLeafSize; ++c) {
    const int i = (c >> 6) + kHalo, j = ((c >> 3) & 7) + kHalo, k = (c & 7) + kHalo;
    const int cell = i * kStride[0] + j * kStride[1] + k * kStride[2];
    if (asked[cell] == 0) continue;
    const int from = sourceOf(cell);
    if (from < 0) continue;
    const Coord fromAt(from / kStride[0], from / kSide % kSide, from % kSide);
    // The cells from which those around are extrapolated, relative to `from`; beyond kFar they count as
    // hidden.
    std::array<Coord, VisibleCells::kCount> way;
    std::array<bool, VisibleCells::kCount> owned;
    int far = 0, at = 0;
    for (int di = -kReach; di <= kReach; ++di) {
      for (int dj = -kReach; dj <= kReach; ++dj) {
        for (int dk = -kReach; dk <= kReach; ++dk, ++at) {
          const int to = sourceOf(cell + di * kStride[0] + dj * kStride[1] + dk * kStride[2]);
          owned[at] = to >= 0;
          if (!owned[at]) continue;
          way[at] = Coord(to / kStride[0], to / kSide % kSide, to % kSide) - fromAt;
          for (int a = 0; a < 3; ++a) far = std::max(far, std::abs(way[at][a]));
        }
      }
    }
    far = std::min(far, kFar);
    for (int a = 0; a < 3; ++a) far = std::min({far, fromAt[a], kSide - 1 - fromAt[a]});
    walk(around, from, far, reached);
    VisibleCells& visible = (*leaf)[c];
    if (around.distance[cell] < 0.0f) visible.setInSolid();
    for (at = 0; at < VisibleCells::kCount; ++at) {
      if (!owned[at]) continue;
      const Coord& w = way[at];
      const bool near = std::abs(w[0]) <= far && std::abs(w[1]) <= far && std::abs(w[2]) <= far;
      if (near && reached[kBoxMiddle + w[0] * kBoxStride[0] + w[1] * kBoxStride[1] + w[2] * kBoxStride[2]])
        continue;
      visible.hide(at);
      any = true;
    }
  }
  return any ? std::move(leaf) : nullptr;
}

}  // namespace

void extrapolateBehind(Stencil& values, const VisibleCells& visible, float gap) {
  if (visible.seesAll()) return;
  VisibleCells known = visible;
  for (const Outwards& cell : kOutwards) {
    if (known.sees(cell.at)) continue;
    float sum = 0.0f;
    for (int n = 0; n < cell.axes; ++n) {
      const int inwards = cell.inwards[n];
      const float near = values[cell.at + inwards];
      // Two steps inwards may pass the middle, but never leave the stencil.
      const int second = cell.at + 2 * inwards;
      const float further = known.sees(second) ? 2.0f * near - values[second] : near;
      const bool sameSide = (further < 0.0f) == (near < 0.0f);
      sum += sameSide || further - near > gap ? further : near;
    }
    values[cell.at] = sum / static_cast<float>(cell.axes);
    known.show(cell.at);
  }
}

void riseBehind(Stencil& values, const VisibleCells& visible, float step) {
  constexpr int kReach = VisibleCells::kReach;
  const Stencil before = values;
  const float middle = before[VisibleCells::kMiddle];
  for (int at = 0; at < VisibleCells::kCount; ++at) {
    if (visible.sees(at)) continue;
    // The place before the wall, back along the axes that the wall blocks.
    int rest = at, foot = at, steps = 0;
    for (int a = 0; a < 3; ++a) {
      const int stride = VisibleCells::kStride[a], away = rest / stride - kReach;
      rest %= stride;
      if (away == 0 || visible.sees(VisibleCells::kMiddle + (away < 0 ? -stride : stride))) continue;
      foot -= away * stride;
      steps += std::abs(away);
    }
    const float near = steps > 0 && visible.sees(foot) ? before[foot] : middle;
    values[at] = near + step * static_cast<float>(std::max(steps, 1));
  }
}

std::shared_ptr<const Visibility> visibilityOf(const FloatGrid& solidPhi, const FaceGrids& open) {
  // Blocks that hold a solid's surface, and their neighbours.
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
    if (around.anySolid()) leaves[n] = look(around);
  });
  auto result = std::make_shared<Visibility>();
  for (std::size_t n = 0; n < all.size(); ++n)
    if (leaves[n] != nullptr) result->add(all[n], std::move(leaves[n]));
  return result->empty() ? nullptr : result;
}

}  // namespace fluidtex::sim
