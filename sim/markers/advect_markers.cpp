#include "sim/grid/block_samples.h"
#include "sim/grid/local_reach.h"
#include "sim/grid/require.h"
#include "sim/markers/marker_sight.h"
#include "sim/solids/own_side_trace.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

// An air marker is dropped where the flow removes more than this share of a cell in a step: there liquid
// meets liquid, and without air pressure nothing of the gap remains. If kept, such markers hold the gap open
// and remove the liquid that flows in: the dam break at 96 cells ends with half of its water. Twice this
// share keeps 4% less of it by frame 30.
constexpr float kMaxSqueeze = 0.1f;

// Index of the neighbour (27 with the block itself) and the shift to it.
int neighborNumber(int di, int dj, int dk) {
  return (di + 1) * 9 + (dj + 1) * 3 + dk + 1;
}
constexpr int kHere = 13;
Coord neighborShift(int number) {
  return Coord((number / 9 - 1) * kLeafDim, (number / 3 % 3 - 1) * kLeafDim, (number % 3 - 1) * kLeafDim);
}

// The side on which a coordinate has left [0, 8); wraps it back.
int wrap(float& x) {
  if (x < 0.0f) {
    if (x + kLeafDim >= float(kLeafDim)) {  // by rounding: not wrapped
      x = 0.0f;
      return 0;
    }
    x += kLeafDim;
    return -1;
  }
  if (x >= float(kLeafDim)) {
    x -= kLeafDim;
    return 1;
  }
  return 0;
}

// Velocities around a block in cells per step, and the volume that they squeeze out of a cell.
struct Motion {
  std::array<BlockSamples, 3> speed{BlockSamples(2), BlockSamples(2), BlockSamples(2)};
  BlockSamples squeeze{1};
  bool anySqueeze = false;  // over kMaxSqueeze anywhere in the block

  void load(const Velocity& velocity, const Coord& origin, int halo, float scale) {
    for (int a = 0; a < 3; ++a) {
      speed[a].setHalo(halo);
      speed[a].load(velocity.component[a]->constTree(), origin, scale);
    }
    const std::ptrdiff_t side = speed[0].side;
    anySqueeze = false;
    for (int i = 0; i <= kLeafDim; ++i) {
      for (int j = 0; j <= kLeafDim; ++j) {
        const float *u = speed[0].sample(i, j, 0), *v = speed[1].sample(i, j, 0),
                    *w = speed[2].sample(i, j, 0);
        float* out = squeeze.value.data() + ((i + 1) * squeeze.side + j + 1) * squeeze.side + 1;
        for (int k = 0; k <= kLeafDim; ++k) {
          out[k] = -(u[k + side * side] - u[k] + v[k + side] - v[k] + w[k + 1] - w[k]);
          anySqueeze = anySqueeze || out[k] > kMaxSqueeze;
        }
      }
    }
  }

  // A component at a place in cells from the block's lower corner.
  float at(int axis, const Vec3f& place) const {
    Vec3f x = place - Vec3f(0.5f);
    x[axis] += 0.5f;
    return speed[axis].at(x[0], x[1], x[2]);
  }

  // Two at a time, since one alone waits for each of its three velocities.
  void trace(Marker& m, Marker& other) const {
    const StaggeredBlocks blocks{{speed[0].value.data(), speed[1].value.data(), speed[2].value.data()},
                                 speed[0].side};
    const Float8 x = joined8(load4(&m.x), load4(&other.x)) + float(speed[0].halo);
    const Float8 k1 = blocks.at(x);
    const Float8 k2 = blocks.at(x + 0.5f * k1);
    const Float8 k3 = blocks.at(x + 0.75f * k2);
    const Float8 move = (2.0f * k1 + 3.0f * k2 + 4.0f * k3) * (1.0f / 9.0f);
    const Float4 a = low4(move), b = high4(move);
    m.x += a[0], m.y += a[1], m.z += a[2];
    other.x += b[0], other.y += b[1], other.z += b[2];
  }
};

// Corrects a marker's way from where it was. Markers are measured from the centre of the block's first cell.
template <class Trace>
void keepOnOwnSide(const Trace& trace, const Marker& was, Marker& m) {
  const auto place = [](const Marker& marker) { return Vec3f(marker.x, marker.y, marker.z) + Vec3f(0.5f); };
  const Vec3f to = trace.corrected(place(was), trace.cellAt(place(was)), place(m)) - Vec3f(0.5f);
  m.x = to[0], m.y = to[1], m.z = to[2];
}

// Of a block: the markers that stay in it, and those that leave, by the neighbour they end in.
struct Moved {
  std::vector<Marker> stay, leave;
  std::array<std::int32_t, 28> start{};  // into `leave`
};

// Traces the markers of a block. In the middle of a thin wall a marker is between the two sides, and the
// smallest motion would put the liquid of one side into the air of the other: such markers are dropped.
void trace(const Motion& motion, const Sight& sight, const Visibility* visibility, const Coord& origin,
           std::vector<Marker>& markers) {
  thread_local std::vector<Marker> before;
  before.clear();
  if (sight.any()) before = markers;
  Marker none{};
  for (std::size_t m = 0; m < markers.size(); m += 2)
    motion.trace(markers[m], m + 1 < markers.size() ? markers[m + 1] : none);
  if (!sight.any()) return;
  const auto speed = [&](int axis, const Vec3f& place) { return motion.at(axis, place); };
  std::size_t kept = 0;
  for (std::size_t number = 0; number < markers.size(); ++number) {
    Marker& m = markers[number];
    keepOnOwnSide(OwnSideTrace(*visibility, origin, speed), before[number], m);
    if (!sight.parts(before[number], m)) markers[kept++] = m;
  }
  markers.resize(kept);
}

// Sorts traced markers by the block that they are in now, with coordinates from its lower corner.
Moved sorted(const std::vector<Marker>& markers) {
  thread_local std::vector<Marker> stay;
  thread_local std::vector<std::pair<int, Marker>> leave;
  stay.clear();
  leave.clear();
  Moved moved;
  std::array<std::int32_t, 28>& start = moved.start;
  for (Marker m : markers) {
    const int di = wrap(m.x), dj = wrap(m.y), dk = wrap(m.z), to = neighborNumber(di, dj, dk);
    if (to == kHere) {
      stay.push_back(m);
    } else {
      ++start[to + 1];
      leave.emplace_back(to, m);
    }
  }
  for (int to = 0; to < 27; ++to) start[to + 1] += start[to];
  std::array<std::int32_t, 28> next = start;
  moved.stay = stay;
  moved.leave.resize(leave.size());
  for (const auto& [to, m] : leave) moved.leave[next[to]++] = m;
  return moved;
}

// Origins of the blocks that hold markers now, ascending.
std::vector<Coord> originsOf(const Markers& markers, const std::vector<Moved>& parts) {
  std::vector<Coord> origins;
  for (std::size_t n = 0; n < markers.size(); ++n) {
    const auto& start = parts[n].start;
    if (!parts[n].stay.empty()) origins.push_back(markers[n].origin);
    for (int to = 0; to < 27; ++to) {
      if (start[to + 1] > start[to]) origins.push_back(markers[n].origin + neighborShift(to));
    }
  }
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  return origins;
}

// The markers that stay in a block and those that enter it. Takes the ones that stay out of `parts`.
std::vector<Marker> gathered(const Coord& origin, const Markers& markers, std::vector<Moved>& parts) {
  thread_local std::vector<Marker> all;
  all.clear();
  for (int from = 0; from < 27; ++from) {
    const MarkerBlock* source = findBlock(markers, origin + neighborShift(from));
    if (source == nullptr) continue;
    Moved& part = parts[std::size_t(source - markers.data())];
    if (from == kHere) {
      all.insert(all.end(), part.stay.begin(), part.stay.end());
      part.stay = std::vector<Marker>();  // frees the memory early
    } else {
      const Marker* first = part.leave.data();
      all.insert(all.end(), first + part.start[26 - from], first + part.start[27 - from]);
    }
  }
  return all;
}

}  // namespace

Markers advectMarkers(Markers markers, const Velocity& velocity, double dt, const Visibility* visibility) {
  if (markers.empty()) return {};
  const double h = velocity.component[0]->voxelSize()[0];
  const float scale = static_cast<float>(dt / h);
  const LocalReach reach(velocity, dt);
  // Beyond this, markers would leave the neighbouring blocks, and read velocities beyond what is copied of
  // those.
  require(dt * maxAbs(velocity) < kMaxTrace * h && reach.farthest() < kMaxTrace,
          "advectMarkers: nothing may move five cells or more in a step");
  std::vector<Moved> parts(markers.size());
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    thread_local Motion motion;
    MarkerBlock& block = markers[n];
    const int halo = static_cast<int>(std::ceil(reach.from(block.origin))) + 2;
    motion.load(velocity, block.origin, halo, scale);
    if (motion.anySqueeze) {
      std::erase_if(block.markers, [&](const Marker& m) {
        return m.radius > 0.0f && motion.squeeze.at(m.x, m.y, m.z) > kMaxSqueeze;
      });
    }
    trace(motion, Sight(visibility, block.origin, halo), visibility, block.origin, block.markers);
    parts[n] = sorted(block.markers);
    block.markers = std::vector<Marker>();  // frees the memory, unlike {}
  });
  const std::vector<Coord> origins = originsOf(markers, parts);
  Markers moved(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    moved[n].origin = origins[n];
    moved[n].markers = gathered(origins[n], markers, parts);
  });
  return moved;
}

}  // namespace fluidtex::sim
