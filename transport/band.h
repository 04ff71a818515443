// Vectors at the centres of the cells around a surface, moved by first-order upwind differences: what the
// paper carries coordinates and directions with [Kwatra07 sec. VI].
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

// Every cell whose velocity is known in one of the frame's substeps.
struct Band {
  static constexpr std::int32_t kNone = -1;
  using IndexTree = sim::TreeOf<std::int32_t>;

  double h = 0.0;     // side of a cell, metres
  Vec3d origin{0.0};  // centre of cell (0, 0, 0)
  std::vector<openvdb::Coord> cells;
  std::vector<std::array<std::int32_t, 6>> neighbor;  // -x, +x, -y, +y, -z, +z; kNone where there is no cell
  IndexTree::Ptr index;                               // cell -> its number, kNone elsewhere

  Vec3d center(std::size_t cell) const { return origin + cells[cell].asVec3d() * h; }
};

// Throws std::invalid_argument if the velocity grids' cells are no cubes, or not all of one size and place.
// No substeps: a band without cells.
Band bandOf(const sim::Frame& frame);

// Velocity at the cells' centres in one substep, m/s; 0 where it would be more than 64 cells a substep.
std::vector<Vec3d> velocityAtCells(const Band& band, const sim::Substep& substep);

// Gradient[i][j] = d u_i / d x_j of the cells' velocities by central differences, one-sided at the band's
// rim.
Mat3d velocityGradient(const Band& band, const std::vector<Vec3d>& velocity, std::size_t cell);

// (u . grad) field at a cell by first-order upwind differences; 0 along an axis whose upwind cell is missing.
Vec3d upwindDerivative(const Band& band, const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& field,
                       std::size_t cell);

// How many equal parts a substep is split into, so that dt (|u| + |v| + |w|) / h < 1 in each.
int subcycles(const Band& band, const std::vector<Vec3d>& velocity, double dt);

// Advances `field` through all substeps, sub-cycled: field(cell) = step(velocity, field, cell, dt), explicit.
using CellStep = std::function<Vec3d(const std::vector<Vec3d>& velocity, const std::vector<Vec3d>& field,
                                     std::size_t cell, double dt)>;
void advance(const Band& band, const sim::Frame& frame, const CellStep& step, std::vector<Vec3d>& field);

// The cells around a position that exist, with their trilinear weights, and the derivatives of these.
struct Corners {
  std::array<std::int32_t, 8> cell{};
  std::array<double, 8> weight{};
  std::array<Vec3d, 8> slope{};  // 1/m
  double known = 0.0;            // sum of the weights of the cells that exist
};
Corners cornersAt(const Band& band, const Vec3d& x);

}  // namespace fluidtex::transport
