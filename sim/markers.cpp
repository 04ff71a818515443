#include "sim/markers.h"

#include "sim/trilinear.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fluidtex::sim {
namespace {

constexpr float kSmallest = 0.1f, kLargest = 0.5f;  // radii [Enright02 sec. 3.1]
constexpr int kPerCell = 16;                        // markers of a full cell
constexpr float kBand = 3.0f;                       // cells: how far from the surface markers are kept
// A marker of the air goes where the flow takes away more than this share of a cell in a step: there liquid
// meets liquid, and without air pressure nothing of the gap is left. Kept, such markers would hold it open
// and eat the liquid that flows in: the dam break at 96 cells ends with half of its water. Twice this share
// keeps 4% less of it by frame 30.
constexpr float kMaxSqueeze = 0.1f;
// Markers of the air this many cells inside the liquid belong to a bubble that has closed.
constexpr float kDeepestAir = 1.0f;

// Values of a box around a block, sampled in the block's own coordinates.
struct Samples {
  int halo, side;
  std::vector<float> value;

  explicit Samples(int width)
      : halo(width), side(kLeafDim + 2 * width), value(std::size_t(side) * side * side) {}

  void load(const FloatTree& tree, const Coord& origin) { gather(tree, origin, halo, value.data()); }

  // The sample at i, j, k.
  const float* sample(int i, int j, int k) const {
    return value.data() + ((i + halo) * side + j + halo) * std::ptrdiff_t(side) + k + halo;
  }

  // Places lie `halo` cells outside the block at most.
  float at(float x, float y, float z) const {
    const float fromX = x + float(halo), fromY = y + float(halo), fromZ = z + float(halo);
    const int i = int(fromX), j = int(fromY), k = int(fromZ);
    const float* p = value.data() + (i * side + j) * std::ptrdiff_t(side) + k;
    return trilinear(p, std::ptrdiff_t(side) * side, side, fromX - float(i), fromY - float(j),
                     fromZ - float(k));
  }

  // Whether one of the eight values around is negative.
  bool anyNegative(float x, float y, float z) const {
    const float* p = sample(int(std::floor(x)), int(std::floor(y)), int(std::floor(z)));
    for (int n = 0; n < 8; ++n)
      if (p[((n >> 2) * side + ((n >> 1) & 1)) * std::ptrdiff_t(side) + (n & 1)] < 0.0f) return true;
    return false;
  }
};

// The range of values at the eight corners of each of a block's cells: what is sampled in it lies between.
struct CellRanges {
  std::array<float, kLeafSize> low, high;

  // May be less than a marker's own range by rounding.
  static constexpr float kRounding = 1e-4f;

  void find(const Samples& samples) {
    constexpr int kPoints = kLeafDim + 1;
    // Along z, then y, then x.
    float lowZ[kPoints][kPoints][kLeafDim], highZ[kPoints][kPoints][kLeafDim];
    for (int i = 0; i < kPoints; ++i) {
      for (int j = 0; j < kPoints; ++j) {
        const float* p = samples.sample(i, j, 0);
        for (int k = 0; k < kLeafDim; ++k) {
          lowZ[i][j][k] = p[k] < p[k + 1] ? p[k] : p[k + 1];
          highZ[i][j][k] = p[k] > p[k + 1] ? p[k] : p[k + 1];
        }
      }
    }
    const auto least = [](float a, float b) { return a < b ? a : b; };
    const auto most = [](float a, float b) { return a > b ? a : b; };
    for (int i = 0; i < kLeafDim; ++i) {
      for (int j = 0; j < kLeafDim; ++j) {
        for (int k = 0; k < kLeafDim; ++k) {
          const int at = 64 * i + 8 * j + k;
          low[at] =
              least(least(lowZ[i][j][k], lowZ[i][j + 1][k]), least(lowZ[i + 1][j][k], lowZ[i + 1][j + 1][k]));
          high[at] = most(most(highZ[i][j][k], highZ[i][j + 1][k]),
                          most(highZ[i + 1][j][k], highZ[i + 1][j + 1][k]));
        }
      }
    }
  }
};

bool before(const MarkerBlock& block, const Coord& origin) {
  return block.origin < origin;
}

template <class Blocks>
auto find(Blocks& markers, const Coord& origin) {
  const auto it = std::lower_bound(markers.begin(), markers.end(), origin, before);
  return it != markers.end() && it->origin == origin ? &*it : nullptr;
}

// Number of the neighbour (27 with the block itself) and the shift to it.
int neighborNumber(int di, int dj, int dk) {
  return (di + 1) * 9 + (dj + 1) * 3 + dk + 1;
}
constexpr int kHere = 13;
Coord neighborShift(int number) {
  return Coord((number / 9 - 1) * kLeafDim, (number / 3 % 3 - 1) * kLeafDim, (number % 3 - 1) * kLeafDim);
}

// Which way a coordinate has left [0, 8), and brings it back.
int wrap(float& x) {
  if (x < 0.0f) {
    x += kLeafDim;
    if (x >= float(kLeafDim)) x = 0.0f;  // rounding
    return -1;
  }
  if (x >= float(kLeafDim)) {
    x -= kLeafDim;
    return 1;
  }
  return 0;
}

// Velocities around a block in cells per step, and how far they press a cell's volume out of it.
struct Motion {
  std::array<Samples, 3> speed{Samples(2), Samples(2), Samples(2)};
  Samples squeeze{1};
  bool anySqueeze = false;  // over kMaxSqueeze anywhere in the block

  void load(const Velocity& velocity, const Coord& origin, int halo, float scale) {
    for (int a = 0; a < 3; ++a) {
      if (speed[a].halo != halo) speed[a] = Samples(halo);
      speed[a].load(velocity.component[a]->constTree(), origin);
      for (float& value : speed[a].value) value *= scale;
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

  void trace(Marker& m) const {
    const StaggeredBlocks blocks{{speed[0].value.data(), speed[1].value.data(), speed[2].value.data()},
                                 speed[0].side};
    const Lanes x = _mm_loadu_ps(&m.x) + lanes(float(speed[0].halo));
    const Lanes k1 = blocks.at(x);
    const Lanes k2 = blocks.at(x + lanes(0.5f) * k1);
    const Lanes k3 = blocks.at(x + lanes(0.75f) * k2);
    const Lanes move = (lanes(2.0f) * k1 + lanes(3.0f) * k2 + lanes(4.0f) * k3) * lanes(1.0f / 9.0f);
    m.x += lane0(move), m.y += lane1(move), m.z += lane2(move);
  }
};

// Counter-based: the same for any order of cells.
float unitRandom(std::uint64_t seed, const Coord& cell, std::uint32_t n) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15ull + n * 0xd1b54a32d192ed03ull;
  for (int a = 0; a < 3; ++a) z = (z ^ static_cast<std::uint32_t>(cell[a])) * 0xff51afd7ed558ccdull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return static_cast<float>(z >> 44) * 0x1p-20f;  // 20 bits: 7 + this stays below 8
}

int cellOf(const Marker& m) {
  return 64 * int(m.x) + 8 * int(m.y) + int(m.z);
}

float side(const Marker& m) {
  return m.radius < 0.0f ? -1.0f : 1.0f;
}

bool escaped(const Marker& m, float phi) {
  return side(m) * phi < -std::abs(m.radius);
}

// Whether the liquid here is no more than a film on the wall: no cell around is liquid, and it gets farther
// one cell away from the wall. (A thread that stands on a wall is as near there as here.)
bool liesOnWall(const Marker& m, const Samples& distance, const Samples& solid, float h) {
  if (distance.anyNegative(m.x, m.y, m.z)) return false;
  const openvdb::Vec3f slope(solid.at(m.x + 0.5f, m.y, m.z) - solid.at(m.x - 0.5f, m.y, m.z),
                             solid.at(m.x, m.y + 0.5f, m.z) - solid.at(m.x, m.y - 0.5f, m.z),
                             solid.at(m.x, m.y, m.z + 0.5f) - solid.at(m.x, m.y, m.z - 0.5f));
  const float length = slope.length();
  if (length < 0.1f * h) return true;  // in the middle of a solid
  const openvdb::Vec3f away = openvdb::Vec3f(m.x, m.y, m.z) + slope / length;
  return distance.at(away[0], away[1], away[2]) > distance.at(m.x, m.y, m.z) + 0.5f * h;
}

void measure(Marker& m, float phi) {
  m.radius = side(m) * std::clamp(side(m) * phi, kSmallest, kLargest);
}

}  // namespace

Markers advectMarkers(const Markers& markers, const Velocity& velocity, double dt) {
  if (markers.empty()) return {};
  const double h = velocity.component[0]->voxelSize()[0];
  const float scale = static_cast<float>(dt / h);
  const int halo = static_cast<int>(std::ceil(dt / h * maxAbs(velocity))) + 2;
  // Of a block: the markers that stay in it, and those that leave, by the neighbour they end in.
  struct Moved {
    std::vector<Marker> stay, leave;
    std::array<std::int32_t, 28> start{};  // into `leave`
  };
  std::vector<Moved> parts(markers.size());
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    thread_local Motion motion;
    thread_local std::vector<Marker> stay;
    thread_local std::vector<std::pair<int, Marker>> leave;
    motion.load(velocity, markers[n].origin, halo, scale);
    stay.clear();
    leave.clear();
    std::array<std::int32_t, 28>& start = parts[n].start;
    for (Marker m : markers[n].markers) {
      if (motion.anySqueeze && m.radius > 0.0f && motion.squeeze.at(m.x, m.y, m.z) > kMaxSqueeze) continue;
      motion.trace(m);
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
    parts[n].stay = stay;
    parts[n].leave.resize(leave.size());
    for (const auto& [to, m] : leave) parts[n].leave[next[to]++] = m;
  });

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
  Markers moved(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    thread_local std::vector<Marker> all;
    all.clear();
    moved[n].origin = origins[n];
    for (int from = 0; from < 27; ++from) {
      const MarkerBlock* source = find(markers, origins[n] + neighborShift(from));
      if (source == nullptr) continue;
      Moved& part = parts[std::size_t(source - markers.data())];
      if (from == kHere) {
        all.insert(all.end(), part.stay.begin(), part.stay.end());
        part.stay = {};  // nobody else wants them
      } else {
        const Marker* first = part.leave.data();
        all.insert(all.end(), first + part.start[26 - from], first + part.start[27 - from]);
      }
    }
    moved[n].markers = all;
  });
  return moved;
}

void correctPhi(FloatGrid& phi, const Markers& markers) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  Markers out(markers.size());  // those that have escaped
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    thread_local Samples distance(1);
    thread_local CellRanges range;
    distance.load(phi.constTree(), markers[n].origin);
    range.find(distance);
    out[n].origin = markers[n].origin;
    const float wrong = (kSmallest - CellRanges::kRounding) * h;
    for (const Marker& m : markers[n].markers) {
      const auto cell = std::size_t(cellOf(m));
      if (m.radius < 0.0f ? range.high[cell] < wrong : range.low[cell] > -wrong) continue;
      if (escaped(m, distance.at(m.x, m.y, m.z) / h)) out[n].markers.push_back(m);
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
      const MarkerBlock* block = find(out, leaves[n]->origin() + shift);
      if (block == nullptr) continue;
      if (!touched) {
        std::copy_n(value, kLeafSize, air.begin());
        std::copy_n(value, kLeafSize, liquid.begin());
        touched = true;
      }
      for (const Marker& m : block->markers) {
        for (int corner = 0; corner < 8; ++corner) {
          const int i = int(m.x) + (corner >> 2) + shift[0], j = int(m.y) + ((corner >> 1) & 1) + shift[1],
                    k = int(m.z) + (corner & 1) + shift[2];
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
    for (int i = 0; i < kLeafSize; ++i) {
      const float right = std::abs(air[i]) <= std::abs(liquid[i]) ? air[i] : liquid[i];
      value[i] = std::clamp(right, -background, background);
    }
  });
}

Markers seedMarkers(const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed) {
  Markers markers;
  maintainMarkers(markers, phi, solidPhi, seed);
  return markers;
}

void maintainMarkers(Markers& markers, const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  std::vector<Coord> origins;
  for (const MarkerBlock& block : markers) origins.push_back(block.origin);
  for (const FloatLeaf* leaf : leavesOf(phi.constTree())) origins.push_back(leaf->origin());
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  Markers next(origins.size());
  tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t n) {
    thread_local Samples distance(2), solid(2);
    thread_local CellRanges range, wallRange;
    distance.load(phi.constTree(), origins[n]);
    solid.load(solidPhi.constTree(), origins[n]);
    range.find(distance);
    wallRange.find(solid);
    next[n].origin = origins[n];
    thread_local std::vector<Marker> kept;
    kept.clear();
    std::array<int, kLeafSize> count{};
    if (MarkerBlock* block = find(markers, origins[n])) {
      constexpr float kRounding = CellRanges::kRounding;
      for (Marker m : block->markers) {
        const auto cell = std::size_t(cellOf(m));
        int& there = count[cell];
        const bool open = wallRange.low[cell] > (kRounding - 1.0f) * h;
        // Most markers are known to have the largest radius.
        const float least = (m.radius < 0.0f ? -range.high[cell] : range.low[cell]) / h,
                    most = (m.radius < 0.0f ? -range.low[cell] : range.high[cell]) / h;
        if (open && least > kLargest + kRounding && most < kBand - kRounding) {
          if (there >= 2 * kPerCell) continue;
          ++there;
          m.radius = side(m) * kLargest;
          kept.push_back(m);
          continue;
        }
        const float here = distance.at(m.x, m.y, m.z) / h;
        const bool out = escaped(m, here);
        if (side(m) * here > kBand) continue;
        if (out && m.radius > 0.0f && -here > kDeepestAir) continue;
        if (!open || out) {
          const float wall = solid.at(m.x, m.y, m.z);
          if (wall < -h) continue;
          // What is left of a film at a wall, with no cell of liquid: nothing would move it any more.
          if (out && wall < h && liesOnWall(m, distance, solid, h)) continue;
        }
        if (!out && there >= 2 * kPerCell) continue;
        ++there;
        measure(m, here);
        kept.push_back(m);
      }
      block->markers = {};  // nobody else wants them
    }
    for (int c = 0; c < kLeafSize; ++c) {
      if (count[std::size_t(c)] > kPerCell / 2) continue;
      if (range.low[std::size_t(c)] > (kBand + CellRanges::kRounding) * h ||
          range.high[std::size_t(c)] < -(kBand + CellRanges::kRounding) * h)
        continue;
      const auto i = float(c >> 6), j = float((c >> 3) & 7), k = float(c & 7);
      // From the middle to a corner it is less than a cell.
      if (std::abs(distance.at(i + 0.5f, j + 0.5f, k + 0.5f)) > (kBand + 1.0f) * h) continue;
      const Coord cell = origins[n].offsetBy(c >> 6, (c >> 3) & 7, c & 7);
      for (int m = count[std::size_t(c)]; m < kPerCell; ++m) {
        const auto random = [&](int axis) { return unitRandom(seed, cell, 3 * std::uint32_t(m) + axis); };
        Marker added{i + random(0), j + random(1), k + random(2), 0.0f};
        const float here = distance.at(added.x, added.y, added.z) / h;
        if (std::abs(here) > kBand || solid.at(added.x, added.y, added.z) < -0.5f * h) continue;
        added.radius = here < 0.0f ? -kSmallest : kSmallest;
        measure(added, here);
        kept.push_back(added);
      }
    }
    next[n].markers = kept;
  });
  std::erase_if(next, [](const MarkerBlock& block) { return block.markers.empty(); });
  markers = std::move(next);
}

}  // namespace fluidtex::sim
