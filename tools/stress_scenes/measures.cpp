#include "tools/stress_scenes/measures.h"

#include "sim/grid/leaf_table.h"
#include "sim/surface/cell_volume.h"
#include "sim/surface/level_set.h"

#include <fmt/core.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace fluidtex::stress {
namespace {

using Accessor = openvdb::tree::ValueAccessor<const sim::FloatTree>;

double square(double x) {
  return x * x;
}

// -gravity . x of the lowest corner of [0, size].
double floorOf(const sim::Options& options) {
  double least = 0.0;
  for (int a = 0; a < 3; ++a) least += std::min(0.0, -options.gravity[a] * options.size[a]);
  return least;
}

// Calls body(cell, share that is liquid) for the cells of all leaves and tiles of phi in the domain that can
// be liquid.
template <class Body>
void forWetCells(const sim::FloatGrid& phi, const sim::SolidField& solid, const Body& body) {
  sim::LeafShares shares;
  for (const Coord& origin : sim::wetLeaves(phi, solid.domain)) {
    sim::liquidShares(phi, solid, origin, shares);
    for (int i = 0; i < sim::kLeafSize; ++i) {
      const Coord cell = origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      if (solid.domain.isInside(cell)) body(cell, shares[i]);
    }
  }
}

// Of the velocity in a cell: its middle, and the mean of what its faces have of its square; whether the
// solver knows it, as it does in the liquid and in the air of the narrow band.
struct CellMotion {
  Vec3d velocity;
  double squares = 0.0;
  bool known = true;
};

CellMotion motionIn(const Accessor (&face)[3], const Coord& cell) {
  CellMotion found;
  for (int a = 0; a < 3; ++a) {
    Coord up = cell;
    up[a] += 1;
    const double low = face[a].getValue(cell), high = face[a].getValue(up);
    found.velocity[a] = 0.5 * (low + high);
    found.squares += 0.5 * (low * low + high * high);
    found.known = found.known && face[a].isValueOn(cell) && face[a].isValueOn(up);
  }
  return found;
}

// Whether the liquid here is part of a sheet or a thread of a cell or two, or of a film on a wall, which is
// half such a sheet. Behind walls phi goes on, and deeper than any liquid there.
bool isThin(const Accessor& phi, const Accessor& solid, const Coord& cell, double h) {
  for (int n = 0; n < 27; ++n) {
    const Coord beside = cell.offsetBy(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
    if (phi.getValue(beside) < -h && solid.getValue(beside) > 0.0f) return false;
  }
  return true;
}

}  // namespace

std::string written(const Vec3d& place) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", place[0], place[1], place[2]);
}

Measures measure(const sim::State& state, const sim::SolidField& field, const sim::Options& options) {
  Measures found;
  const double h = options.voxelSize(), cube = h * h * h, floor = floorOf(options);
  Accessor phi(state.phi->constTree()), solid(field.phi->constTree());
  Accessor face[3] = {Accessor(state.velocity.component[0]->constTree()),
                      Accessor(state.velocity.component[1]->constTree()),
                      Accessor(state.velocity.component[2]->constTree())};
  found.lowest = INFINITY;
  const auto wet = [&](const Coord& cell) { return std::clamp(0.5 - phi.getValue(cell) / h, 0.0, 1.0); };
  forWetCells(*state.phi, field, [&](const Coord& cell, double share) {
    const double p = phi.getValue(cell), s = solid.getValue(cell);
    const Vec3d x = (cell.asVec3d() + Vec3d(0.5)) * h;
    const double high = -options.gravity.dot(x);
    // The area is the integral of the gradient's length of what is 1 in the liquid and 0 outside.
    double slope = 0.0;
    for (int a = 0; a < 3; ++a) {
      Coord low = cell, up = cell;
      low[a] -= 1;
      up[a] += 1;
      slope += square((wet(up) - wet(low)) / (2.0 * h));
    }
    found.area += std::sqrt(slope) * std::clamp(0.5 + s / h, 0.0, 1.0) * cube;
    if (share <= 0.0) return;
    const auto [velocity, squares, known] = motionIn(face, cell);
    const double mass = options.density * share * cube;
    found.mass += mass;
    if (isThin(phi, solid, cell, h)) found.thin += share * cube;
    found.kinetic += 0.5 * mass * squares;
    if (std::abs(p) < 0.5 * h) found.surfaceMotion += 0.5 * options.density * cube * squares;
    found.potential += mass * (high - floor);
    found.falling += mass * options.gravity.dot(velocity);
    if (p >= 0.0 || s < 0.0) return;
    found.lowest = std::min(found.lowest, high);
    if (const double speed = velocity.length(); !(speed <= found.speed.value)) found.speed = {speed, x};
  });
  found.surface = options.surfaceTension * found.area;
  if (state.deficit == nullptr) return found;
  const double squaresOnTheWhole = found.mass > 0.0 ? 2.0 * found.kinetic / found.mass : 0.0;
  for (auto it = state.deficit->cbeginValueOn(); it; ++it) {
    const Coord cell = it.getCoord();
    const Vec3d x = (cell.asVec3d() + Vec3d(0.5)) * h;
    const double mass = options.density * *it * cube;
    found.potential += mass * (-options.gravity.dot(x) - floor);
    const CellMotion motion = motionIn(face, cell);
    found.deficitMotion += 0.5 * mass * (motion.known ? motion.squares : squaresOnTheWhole);
    if (std::abs(*it) > std::abs(found.deficit.value)) found.deficit = {*it, x};
  }
  return found;
}

namespace {

// Whether all tiles of one tree that differ from its background are in the other too.
bool holdsTiles(const sim::FloatTree& tree, const sim::FloatTree& other) {
  auto it = tree.cbeginValueAll();
  it.setMaxDepth(it.getLeafDepth() - 1);
  for (; it; ++it) {
    if (!it.isValueOn() && *it == tree.background()) continue;
    float value = 0.0f;
    if (other.probeValue(it.getCoord(), value) != it.isValueOn() || value != *it) return false;
  }
  return true;
}

bool hasSameTiles(const sim::FloatTree& one, const sim::FloatTree& other) {
  return one.background() == other.background() && one.activeTileCount() == other.activeTileCount() &&
         holdsTiles(one, other) && holdsTiles(other, one);
}

// Of two grids of one name; empty where they are the same to the bit. Inner nodes without a leaf, which files
// leave out, hold nothing.
std::string gridDifference(const std::string& name, const sim::FloatGrid* one, const sim::FloatGrid* other) {
  if ((one == nullptr) != (other == nullptr)) return name + ", which one lacks";
  if (one == nullptr) return "";
  if (one->transform() != other->transform()) return name + ", its place";
  if (one->tree().leafCount() != other->tree().leafCount()) return name + ", its cells";
  auto second = other->tree().cbeginLeaf();
  for (auto first = one->tree().cbeginLeaf(); first; ++first, ++second) {
    if (first->origin() != second->origin() || first->valueMask() != second->valueMask())
      return name + ", its cells";
    for (int i = 0; i < sim::kLeafSize; ++i) {
      const float &mine = first->buffer().data()[i], &its = second->buffer().data()[i];
      if (std::bit_cast<std::uint32_t>(mine) == std::bit_cast<std::uint32_t>(its)) continue;
      return fmt::format("{}, {} and {} at {}", name, mine, its,
                         written(one->indexToWorld(first->offsetToGlobalCoord(i))));
    }
  }
  return hasSameTiles(one->tree(), other->tree()) ? "" : name + ", a tile";
}

}  // namespace

std::string notFinite(const sim::State& state) {
  std::string found;
  sim::forEachGrid(state, [&](const char* name, const sim::FloatGrid::Ptr& grid, int) {
    if (grid == nullptr || !found.empty()) return;
    for (auto leaf = std::as_const(*grid).constTree().cbeginLeaf(); leaf; ++leaf) {
      for (int i = 0; i < sim::kLeafSize; ++i)
        if (!std::isfinite(leaf->buffer().data()[i])) found = name;
    }
  });
  return found;
}

std::string difference(const sim::State& a, const sim::State& b) {
  if (a.frame != b.frame || a.steps != b.steps) return "the number of steps";
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  if (bits(a.time) != bits(b.time) || bits(a.leapfrogOffset) != bits(b.leapfrogOffset)) return "the time";
  if (a.poured != b.poured) return "what is poured";
  std::vector<const sim::FloatGrid*> others;
  sim::forEachGrid(b,
                   [&](const char*, const sim::FloatGrid::Ptr& grid, int) { others.push_back(grid.get()); });
  std::string found;
  auto theirs = others.begin();
  sim::forEachGrid(a, [&](const char* name, const sim::FloatGrid::Ptr& grid, int) {
    if (found.empty()) found = gridDifference(name, grid.get(), *theirs);
    ++theirs;
  });
  if (!found.empty()) return found;
  if (a.markers.size() != b.markers.size()) return "the markers' blocks";
  for (std::size_t n = 0; n < a.markers.size(); ++n) {
    const auto &one = a.markers[n], &other = b.markers[n];
    if (one.origin != other.origin || one.markers.size() != other.markers.size() ||
        std::memcmp(one.markers.data(), other.markers.data(), one.markers.size() * sizeof(sim::Marker)) != 0)
      return "the markers";
  }
  return "";
}

}  // namespace fluidtex::stress
