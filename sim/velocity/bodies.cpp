#include "sim/velocity/bodies.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace fluidtex::sim {
namespace {

constexpr std::int32_t kNoPart = Bodies::kNone;
// Cells farther from solids, in cells, have no face that one covers.
constexpr float kBesideWalls = 1.5f;

// What there is of a body, in cells.
struct Part {
  int cells = 0;
  CoordBBox box;                  // around them
  std::array<double, 3> walls{};  // area that holds it along each axis
  std::array<bool, 3> goesOn{};   // where it is held whatever the walls are

  void add(const Part& other) {
    cells += other.cells;
    box.expand(other.box);
    for (int a = 0; a < 3; ++a) {
      walls[a] += other.walls[a];
      goesOn[a] = goesOn[a] || other.goesOn[a];
    }
  }
};

// The connected parts of the liquid within one leaf.
struct LeafParts {
  std::int32_t* of = nullptr;  // of each cell, or kNoPart
  std::vector<Part> parts;
  std::vector<std::uint8_t> closed;  // of each cell, its lower faces that are (bits); empty for none
  bool full = false;                 // all cells are of one part, and none of its faces is closed

  bool connects(int cell, int axis) const { return closed.empty() || ((closed[cell] >> axis) & 1) == 0; }
};

Coord cellOf(const Coord& origin, int offset) {
  return origin.offsetBy(offset >> 6, (offset >> 3) & 7, offset & 7);
}

// A forest in which the root of each tree is its lowest index.
std::int32_t rootOf(std::int32_t* above, std::int32_t i) {
  while (above[i] != i) i = above[i] = above[above[i]];
  return i;
}

void merge(std::int32_t* above, std::int32_t i, std::int32_t j) {
  const std::int32_t a = rootOf(above, i), b = rootOf(above, j);
  above[std::max(a, b)] = std::min(a, b);
}

std::vector<std::uint8_t> closedFaces(const SolidField& solid, const Coord& origin) {
  std::vector<std::uint8_t> closed;
  for (int axis = 0; axis < 3; ++axis) {
    const FloatTree& tree = solid.open[axis].constTree();
    const FloatLeaf* leaf = tree.probeConstLeaf(origin);
    if (leaf == nullptr && tree.getValue(origin) > 0.0f) continue;
    closed.resize(kLeafSize, 0);
    for (int i = 0; i < kLeafSize; ++i)
      if (leaf == nullptr || leaf->buffer().data()[i] <= 0.0f) closed[i] |= 1 << axis;
  }
  return closed;
}

// Numbers the parts of a leaf whose cells are marked in `leaf.of`; how many there are.
std::int32_t connect(LeafParts& leaf) {
  std::int32_t above[kLeafSize];
  for (int i = 0; i < kLeafSize; ++i) {
    above[i] = i;
    if (leaf.of[i] == kNoPart) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const int stride = kLeafStride[axis];
      if (((i / stride) & 7) != 0 && leaf.of[i - stride] != kNoPart && leaf.connects(i, axis))
        merge(above, i, i - stride);
    }
  }
  std::int32_t count = 0;
  for (int i = 0; i < kLeafSize; ++i) {
    if (leaf.of[i] == kNoPart) continue;
    const std::int32_t root = rootOf(above, i);
    leaf.of[i] = root == i ? count++ : leaf.of[root];
  }
  return count;
}

// Finds what holds a part at its cells.
class Holds {
 public:
  explicit Holds(const SolidField& solid)
      : m_solid(solid),
        m_open{solid.open[0].getConstAccessor(), solid.open[1].getConstAccessor(),
               solid.open[2].getConstAccessor()} {}

  void addTo(Part& part, const Coord& cell) const {
    double area[3], all = 0.0;
    for (int a = 0; a < 3; ++a) {
      Coord above = cell;
      above[a] += 1;
      const float low = m_open[a].getValue(cell), high = m_open[a].getValue(above);
      // Of the wall in the cell, or of one on either side of it.
      area[a] = low <= 0.0f && high <= 0.0f ? 2.0 : std::abs(high - low);
      all += area[a];
    }
    const bool sticks =
        all > 0.0 && m_solid.slipLength && std::isfinite(m_solid.slipLength->constTree().getValue(cell));
    for (int a = 0; a < 3; ++a) part.walls[a] += sticks ? all : area[a];
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      if (cell[axis] != (side % 2 == 0 ? m_solid.domain.min() : m_solid.domain.max())[axis]) continue;
      if (m_solid.sides[side] == Side::symmetry) part.goesOn[axis] = true;
      if (m_solid.sides[side] == Side::open || m_solid.sides[side] == Side::stream) part.goesOn.fill(true);
    }
  }

 private:
  const SolidField& m_solid;
  std::array<FloatGrid::ConstAccessor, 3> m_open;
};

// wall: the solids' distance in the leaf's cells, metres.
void describe(LeafParts& leaf, const SolidField& solid, const std::vector<const FloatGrid*>& openings,
              const Coord& origin, const float* wall) {
  const float h = static_cast<float>(solid.voxelSize);
  const Holds holds(solid);
  for (int i = 0; i < kLeafSize; ++i) {
    if (leaf.of[i] == kNoPart) continue;
    Part& part = leaf.parts[leaf.of[i]];
    const Coord cell = cellOf(origin, i);
    if (!leaf.full) part.add({1, CoordBBox(cell, cell), {}, {}});
    if (wall[i] < kBesideWalls * h) holds.addTo(part, cell);
    for (const FloatGrid* opening : openings)
      if (opening->constTree().getValue(cell) < h) part.goesOn.fill(true);
  }
  if (leaf.full) leaf.parts[0].add({kLeafSize, CoordBBox(origin, origin.offsetBy(kLeafDim - 1)), {}, {}});
}

LeafParts partsOf(const FloatTree& phi, const SolidField& solid,
                  const std::vector<const FloatGrid*>& openings, const Coord& origin, std::int32_t* of) {
  LeafParts leaf{of, {}, {}};
  float phiScratch[kLeafSize], wallScratch[kLeafSize];
  const float* liquid = leafValues(phi, origin, phiScratch);
  const float* wall = leafValues(solid.phi->constTree(), origin, wallScratch);
  int count = 0;
  for (int i = 0; i < kLeafSize; ++i) {
    const bool wet = liquid[i] < 0.0f && wall[i] > 0.0f;
    of[i] = wet ? 0 : kNoPart;
    count += wet;
  }
  if (count == 0) return leaf;
  leaf.closed = closedFaces(solid, origin);
  leaf.full = count == kLeafSize && leaf.closed.empty();
  leaf.parts.resize(leaf.full ? 1 : connect(leaf));
  describe(leaf, solid, openings, origin, wall);
  return leaf;
}

// Calls touch(part, part of the next leaf) for cells of the two that share an open face; `axis` leads to the
// next.
template <class Touch>
void acrossFaces(const LeafParts& leaf, const LeafParts& next, int axis, const Touch& touch) {
  if (leaf.full && next.full) {
    touch(0, 0);
    return;
  }
  const int across = kLeafStride[axis], one = kLeafStride[(axis + 1) % 3],
            other = kLeafStride[(axis + 2) % 3];
  for (int i = 0; i < kLeafDim; ++i) {
    for (int j = 0; j < kLeafDim; ++j) {
      const int there = i * one + j * other, here = there + (kLeafDim - 1) * across;
      if (leaf.of[here] != kNoPart && next.of[there] != kNoPart && next.connects(there, axis))
        touch(leaf.of[here], next.of[there]);
    }
  }
}

// The body of each part of all leaves, where leaf n's are numbered from start[n] on; how many there are.
std::pair<std::vector<std::int32_t>, std::int32_t> joined(const LeafTable& table,
                                                          const std::vector<LeafParts>& leaves,
                                                          const std::vector<std::int32_t>& start) {
  std::vector<std::int32_t> above(start.back());
  std::iota(above.begin(), above.end(), 0);
  for (std::size_t n = 0; n < leaves.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t next = table.next[n][2 * axis + 1];
      if (next < 0 || leaves[n].parts.empty() || leaves[next].parts.empty()) continue;
      acrossFaces(leaves[n], leaves[next], axis,
                  [&](int here, int there) { merge(above.data(), start[n] + here, start[next] + there); });
    }
  }
  std::int32_t count = 0;
  std::vector<std::int32_t> body(above.size());
  for (std::int32_t i = 0; i < start.back(); ++i) {
    const std::int32_t root = rootOf(above.data(), i);
    body[i] = root == i ? count++ : body[root];
  }
  return {std::move(body), count};
}

Vec3d freeShare(const Part& body) {
  Vec3d free;
  for (int a = 0; a < 3; ++a) {
    const double section = static_cast<double>(body.cells) / body.box.dim()[a];
    free[a] = body.goesOn[a] ? 0.0 : std::max(0.0, 1.0 - body.walls[a] / section);
  }
  return free;
}

}  // namespace

Bodies bodiesOf(const FloatGrid& phi, const FloatTree& topology, const SolidField& solid,
                const std::vector<const FloatGrid*>& openings) {
  Bodies bodies{makeLeafTable(topology), {}, {}};
  bodies.of.resize(bodies.table.voxels());
  std::vector<LeafParts> leaves(bodies.table.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    leaves[n] =
        partsOf(phi.constTree(), solid, openings, bodies.table.origins[n], bodies.of.data() + n * kLeafSize);
  });
  std::vector<std::int32_t> start(leaves.size() + 1, 0);
  for (std::size_t n = 0; n < leaves.size(); ++n)
    start[n + 1] = start[n] + static_cast<std::int32_t>(leaves[n].parts.size());
  const auto [body, count] = joined(bodies.table, leaves, start);
  std::vector<Part> whole(count);
  for (std::size_t n = 0; n < leaves.size(); ++n)
    for (std::size_t part = 0; part < leaves[n].parts.size(); ++part)
      whole[body[start[n] + part]].add(leaves[n].parts[part]);
  for (const Part& part : whole) bodies.free.push_back(freeShare(part));
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&, &bodyOf = body](std::size_t n) {
    if (leaves[n].parts.empty()) return;
    for (int i = 0; i < kLeafSize; ++i)
      if (leaves[n].of[i] != kNoPart) leaves[n].of[i] = bodyOf[start[n] + leaves[n].of[i]];
  });
  return bodies;
}

}  // namespace fluidtex::sim
