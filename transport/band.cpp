#include "transport/band.h"

#include "texture/loops/parallel.h"
#include "transport/velocity_sampler.h"
#include "transport/within_reach.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fluidtex::transport {
namespace {

using openvdb::Coord;

// Cells per substep: faster faces have no velocity of the simulation.
constexpr double kFastest = 64.0;
constexpr double kMostCells = 0.9;  // cells per part of a substep, summed over the axes

const sim::FloatGrid::ConstPtr& component(const sim::Substep& substep, int axis) {
  return axis == 0 ? substep.u : axis == 1 ? substep.v : substep.w;
}

void checkPlace(const Band& band, const sim::FloatGrid& grid, int axis) {
  Vec3d center = grid.indexToWorld(Coord(0));
  center[axis] += 0.5 * band.h;
  const Vec3d size = grid.voxelSize();
  const bool cubes =
      std::max({size[0], size[1], size[2]}) - std::min({size[0], size[1], size[2]}) < 1e-6 * band.h;
  if (!cubes || std::abs(size[0] - band.h) > 1e-6 * band.h || (center - band.origin).length() > 1e-4 * band.h)
    throw std::invalid_argument(
        "transport on the grid: the velocity grids are not those of one staggered grid of cubes");
}

}  // namespace

Band bandOf(const sim::Frame& frame) {
  Band band;
  band.index = std::make_shared<sim::IndexTree>(Band::kNone);
  sim::MaskTree mask;
  for (const sim::Substep& substep : frame.substeps) {
    for (int axis = 0; axis < 3; ++axis) {
      const sim::FloatGrid::ConstPtr& grid = component(substep, axis);
      if (!grid) continue;
      if (band.h == 0.0) {
        band.h = grid->voxelSize()[0];
        band.origin = grid->indexToWorld(Coord(0));
        band.origin[axis] += 0.5 * band.h;
      }
      checkPlace(band, *grid, axis);
      mask.topologyUnion(grid->tree());
    }
  }
  mask.voxelizeActiveTiles();
  for (auto leaf = mask.cbeginLeaf(); leaf; ++leaf) {
    auto* target = band.index->touchLeaf(leaf->origin());
    for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
      target->setValueOn(voxel.pos(), std::int32_t(band.cells.size()));
      band.cells.push_back(voxel.getCoord());
    }
  }
  band.neighbor.resize(band.cells.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, band.cells.size(), texture::kGrain),
                    [&](const auto& range) {
                      openvdb::tree::ValueAccessor<const sim::IndexTree> index(*band.index);
                      for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
                        for (int side = 0; side < 6; ++side) {
                          Coord beside = band.cells[cell];
                          beside[side / 2] += side % 2 ? 1 : -1;
                          band.neighbor[cell][std::size_t(side)] = index.getValue(beside);
                        }
                      }
                    });
  return band;
}

std::vector<Vec3d> velocityAtCells(const Band& band, const sim::Substep& substep) {
  std::vector<Vec3d> velocity(band.cells.size());
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, velocity.size(), texture::kGrain), [&](const auto& range) {
        VelocitySampler sampler(substep);
        for (std::size_t cell = range.begin(); cell != range.end(); ++cell) {
          const Vec3d u = sampler.velocity(band.center(cell)).velocity;
          const double cells = substep.dt * (std::abs(u[0]) + std::abs(u[1]) + std::abs(u[2])) / band.h;
          velocity[cell] = cells < kFastest ? u : Vec3d(0.0);
        }
      });
  return velocity;
}

Mat3d velocityGradient(const Band& band, const std::vector<Vec3d>& velocity, std::size_t cell) {
  Mat3d gradient;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t lower = band.neighbor[cell][std::size_t(2 * axis)],
                       upper = band.neighbor[cell][std::size_t(2 * axis + 1)];
    const int sides = (lower != Band::kNone) + (upper != Band::kNone);
    const Vec3d& from = lower != Band::kNone ? velocity[std::size_t(lower)] : velocity[cell];
    const Vec3d& to = upper != Band::kNone ? velocity[std::size_t(upper)] : velocity[cell];
    gradient.setCol(axis, sides > 0 ? (to - from) / (sides * band.h) : Vec3d(0.0));
  }
  return gradient;
}

Vec3d upwindDerivative(const Band& band, const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& field,
                       std::size_t cell) {
  const Vec3d& u = velocity[cell];
  Vec3d sum(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const std::int32_t upwind = band.neighbor[cell][std::size_t(2 * axis + (u[axis] > 0.0 ? 0 : 1))];
    if (upwind == Band::kNone) continue;
    sum += (field[cell] - field[std::size_t(upwind)]) * (std::abs(u[axis]) / band.h);
  }
  return sum;
}

int subcycles(const Band& band, const std::vector<Vec3d>& velocity, double dt) {
  double fastest = 0.0;
  for (const Vec3d& u : velocity)
    fastest = std::max(fastest, std::abs(u[0]) + std::abs(u[1]) + std::abs(u[2]));
  return std::max(1, int(std::ceil(dt * fastest / (kMostCells * band.h))));
}

void advance(const Band& band, const sim::Frame& frame, const CellStep& step, std::vector<Vec3d>& field) {
  std::vector<Vec3d> next(field.size());
  for (const sim::Substep& substep : frame.substeps) {
    const std::vector<Vec3d> velocity = velocityAtCells(band, substep);
    const int parts = subcycles(band, velocity, substep.dt);
    for (int part = 0; part < parts; ++part) {
      texture::forEachIndex(field.size(), [&](std::uint32_t cell) {
        next[cell] = step(velocity, field, cell, substep.dt / parts);
      });
      field.swap(next);
    }
  }
}

Corners cornersAt(const Band& band, const Vec3d& x) {
  Corners corners;
  corners.cell.fill(Band::kNone);
  if (band.cells.empty()) return corners;
  const Vec3d index = (x - band.origin) / band.h;
  if (!withinReach(index)) return corners;
  const Vec3d floor(std::floor(index[0]), std::floor(index[1]), std::floor(index[2]));
  const Vec3d t = index - floor;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    const std::array<int, 3> upper{int(corner >> 2 & 1), int(corner >> 1 & 1), int(corner & 1)};
    const auto part = [&](int axis) { return upper[std::size_t(axis)] ? t[axis] : 1.0 - t[axis]; };
    corners.cell[corner] = band.index->getValue(
        Coord(int(floor[0]) + upper[0], int(floor[1]) + upper[1], int(floor[2]) + upper[2]));
    if (corners.cell[corner] == Band::kNone) continue;
    corners.weight[corner] = part(0) * part(1) * part(2);
    corners.known += corners.weight[corner];
    for (int axis = 0; axis < 3; ++axis) {
      const double others = part((axis + 1) % 3) * part((axis + 2) % 3);
      corners.slope[corner][axis] = (upper[std::size_t(axis)] ? others : -others) / band.h;
    }
  }
  return corners;
}

}  // namespace fluidtex::transport
