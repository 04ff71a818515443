// First-order upwind advection of vectors at the centres of cells around a surface, as the paper transports
// coordinates and directions [Kwatra07 sec. VI].
#pragma once

#include "sim/frame/frame.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

// All cells whose velocity is known in one of the frame's substeps.
struct Band {
  static constexpr std::int32_t kNone = -1;

  double h = 0.0;     // side of a cell, metres
  Vec3d origin{0.0};  // centre of cell (0, 0, 0)
  std::vector<openvdb::Coord> cells;
  std::vector<std::array<std::int32_t, 6>> neighbor;  // -x, +x, -y, +y, -z, +z; kNone: no cell
  sim::IndexTree::Ptr index;                          // cell -> its index, kNone elsewhere

  Vec3d center(std::size_t cell) const { return origin + cells[cell].asVec3d() * h; }
};

// Throws std::invalid_argument if cells of the velocity grids are not cubes, or differ in size or alignment.
// Without substeps the band has no cells.
Band bandOf(const sim::Frame& frame);

// Velocity at the cells' centres in one substep, m/s; 0 where it exceeds 64 cells per substep.
std::vector<Vec3d> velocityAtCells(const Band& band, const sim::Substep& substep);

// gradient[i][j] = d u_i / d x_j of the cells' velocities, 1/s: central differences, one-sided at the band's
// rim.
Mat3d velocityGradient(const Band& band, const std::vector<Vec3d>& velocity, std::size_t cell);

// (u . grad) field at a cell by first-order upwind differences; 0 along an axis without upwind cell.
Vec3d upwindDerivative(const Band& band, const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& field,
                       std::size_t cell);

// Number of equal parts of a substep such that dt (|u| + |v| + |w|) / h < 1 in each.
int subcycles(const Band& band, const std::vector<Vec3d>& velocity, double dt);

// Advances `field` through all substeps, sub-cycled, by the explicit update field(cell) = step(velocity,
// field, cell, dt).
using CellStep = std::function<Vec3d(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& field,
                                     std::size_t cell, double dt)>;
void advance(const Band& band, const sim::Frame& frame, const CellStep& step, std::vector<Vec3d>& field);

// Existing cells around a position, with their trilinear weights and the derivatives of these.
struct Corners {
  std::array<std::int32_t, 8> cell{};
  std::array<double, 8> weight{};
  std::array<Vec3d, 8> slope{};  // 1/m
  double known = 0.0;            // sum of the weights of existing cells
};
Corners cornersAt(const Band& band, const Vec3d& x);

}  // namespace fluidtex::transport
