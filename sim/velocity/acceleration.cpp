#include "sim/velocity/acceleration.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/velocity_window.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// Of cells of one body.
struct Sum {
  std::int32_t body;
  double cells = 0.0;
  Vec3d change{0.0};
};

// The sum of a body in a leaf, of which there are few.
Sum& sumOf(std::vector<Sum>& sums, std::int32_t body) {
  const auto found = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) { return sum.body == body; });
  if (found != sums.end()) return *found;
  return sums.emplace_back(Sum{body});
}

// A velocity at the centres of a leaf's cells.
class CentreVelocity {
 public:
  CentreVelocity(const Velocity& velocity, const Coord& origin) {
    for (int axis = 0; axis < 3; ++axis) {
      Coord next = origin;
      next[axis] += kLeafDim;
      const FloatTree& tree = velocity[axis].constTree();
      m_low[axis] = leafValues(tree, origin, m_scratch[axis][0].data());
      m_next[axis] = leafValues(tree, next, m_scratch[axis][1].data());
    }
  }

  Vec3f at(int cell) const {
    Vec3f velocity;
    for (int axis = 0; axis < 3; ++axis) {
      const int stride = kLeafStride[axis], last = (kLeafDim - 1) * stride;
      const bool isLast = ((cell / stride) & 7) == kLeafDim - 1;
      const float high = isLast ? m_next[axis][cell - last] : m_low[axis][cell + stride];
      velocity[axis] = 0.5f * (m_low[axis][cell] + high);
    }
    return velocity;
  }

 private:
  const float* m_low[3];
  const float* m_next[3];
  std::array<std::array<std::array<float, kLeafSize>, 2>, 3> m_scratch;
};

// The changes of a leaf's cells along their ways, summed up by body. window: to work with.
std::vector<Sum> changesIn(std::size_t leaf, const Velocity& a, const Velocity& from, const Velocity& to,
                           const Bodies& bodies, float step, VelocityWindow& window) {
  const std::int32_t* const body = bodies.of.data() + leaf * kLeafSize;
  const auto counts = [&](std::int32_t b) { return b != Bodies::kNone && bodies.free[b] != Vec3d(0.0); };
  std::vector<Sum> sums;
  if (std::none_of(body, body + kLeafSize, counts)) return sums;
  // Within a body two of eight cells, whose middle is that of the eight, stand for all.
  const bool within = std::all_of(body, body + kLeafSize, [&](std::int32_t b) { return b == body[0]; });
  const Coord& origin = bodies.table.origins[leaf];
  const CentreVelocity start(from, origin), end(to, origin);
  std::vector<std::pair<int, Vec3f>> ways;  // of cells: back to where they come from
  ways.reserve(kLeafSize);
  float farthest = 0.0f;
  for (int i = 0; i < kLeafSize; ++i) {
    const int odd = i & 0111;
    if (!counts(body[i]) || (within && odd != 0 && odd != 0111)) continue;
    const Vec3f way = -0.5f * step * (start.at(i) + end.at(i));
    for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(way[axis]));
    ways.emplace_back(i, way);
  }
  window.setHalo(std::min(kLeafDim, static_cast<int>(std::ceil(farthest)) + 1));
  window.load(a, origin);
  const double cells = within ? 4.0 : 1.0;
  for (const auto& [i, way] : ways) {
    const Vec3f centre(static_cast<float>(i >> 6) + 0.5f, static_cast<float>((i >> 3) & 7) + 0.5f,
                       static_cast<float>(i & 7) + 0.5f);
    Sum& sum = sumOf(sums, body[i]);
    sum.cells += cells;
    sum.change += cells * Vec3d(window.at(centre + way) - window.atCentre(i));
  }
  return sums;
}

}  // namespace

Velocity plus(const Velocity& u, const Velocity& a, double time) {
  const float factor = static_cast<float>(time);
  Velocity sum = copyOf(u);
  for (int axis = 0; axis < 3; ++axis) {
    const auto leaves = leavesOf(sum.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const FloatLeaf* from = a.component[axis]->constTree().probeConstLeaf(leaves[n]->origin());
      if (from == nullptr) return;
      float* to = leaves[n]->buffer().data();
      const float* add = from->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) to[i] += factor * add[i];
    });
  }
  return sum;
}

Velocity accelerationBy(Velocity before, const Velocity& after, const FaceMasks& valid, double dt) {
  const auto& masks = valid.component;
  const float rate = static_cast<float>(1.0 / dt);
  for (int axis = 0; axis < 3; ++axis) {
    before.component[axis]->tree().topologyUnion(after.component[axis]->constTree());
    const auto leaves = leavesOf(before.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const Coord& origin = leaves[n]->origin();
      const auto* mask = masks[axis]->constTree().probeConstLeaf(origin);
      float scratch[kLeafSize];
      const float* is = leafValues(after.component[axis]->constTree(), origin, scratch);
      float* value = leaves[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i)
        value[i] = mask != nullptr && mask->isValueOn(i) ? (is[i] - value[i]) * rate : 0.0f;
    });
  }
  return before;
}

std::vector<Vec3d> meanChangeAlong(const Velocity& a, const Velocity& from, const Velocity& to,
                                   const Bodies& bodies, double dt) {
  const float step = static_cast<float>(dt / to[0].voxelSize()[0]);
  std::vector<std::vector<Sum>> sums(bodies.table.size());
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, sums.size()), [&](const Range& range) {
    VelocityWindow window(kLeafDim);
    for (std::size_t n = range.begin(); n != range.end(); ++n)
      sums[n] = changesIn(n, a, from, to, bodies, step, window);
  });
  std::vector<Sum> whole(bodies.size());
  for (const std::vector<Sum>& leaf : sums) {
    for (const Sum& sum : leaf) {
      whole[sum.body].cells += sum.cells;
      whole[sum.body].change += sum.change;
    }
  }
  std::vector<Vec3d> mean(bodies.size(), Vec3d(0.0));
  for (int b = 0; b < bodies.size(); ++b)
    if (whole[b].cells > 0.0) mean[b] = bodies.free[b] * (whole[b].change / whole[b].cells);
  return mean;
}

void add(Velocity& u, const Velocity& a, const Bodies& bodies, const std::vector<Vec3d>& change,
         double time) {
  const float factor = static_cast<float>(time);
  for (int axis = 0; axis < 3; ++axis) {
    const auto leaves = leavesOf(u.component[axis]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      float scratch[kLeafSize];
      const float* from = leafValues(a[axis].constTree(), leaves[n]->origin(), scratch);
      float* to = leaves[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) {
        const std::int32_t body = bodies.ofFace(static_cast<std::int64_t>(n) * kLeafSize + i, axis);
        const float more = body == Bodies::kNone ? 0.0f : static_cast<float>(change[body][axis]);
        to[i] += factor * (from[i] + more);
      }
    });
  }
}

}  // namespace fluidtex::sim
