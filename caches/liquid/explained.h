// How far a frame's velocities carry the surface of the last frame to that of this one.
#pragma once

#include "sim/grid/mac_grid.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <vector>

namespace fluidtex::caches {

using openvdb::Vec3d;

// Up to `most` points of the surface phi = 0 (metres), evenly taken from the tree's own order.
std::vector<Vec3d> surfacePoints(const openvdb::FloatGrid& phi, std::size_t most);

// Velocity of a frame from the grids of its begin and end: u(t) = (1 - w(t)) begin + w(t) end, where both are
// known, with w linear in time between 0 and 1 and of this mean: from 0 to 2 w where w <= 1/2, else from
// 2 w - 1 to 1. Solvers differ in which of their velocities moves a frame to the next: mean weight 0 is that
// of its begin, 1 that of its end. t: 0 to 1, share of the frame.
double weightAt(double meanWeight, double t);

// How far points move in `seconds`, metres (#P): second-order Runge-Kutta, steps of half a cell, at most 64.
std::vector<Vec3d> displacements(const std::vector<Vec3d>& points, const sim::FaceGrids& begin,
                                 const sim::FaceGrids& end, double meanWeight, double seconds);

// 1 - sum phi(x + d)^2 / sum phi(x)^2 over points x of the last surface that are at least a quarter of a cell
// from this one, phi clamped to 5 cells: 1 where the velocity explains all of the surface's motion, 0 where
// it does no better than none. Nothing where fewer than 30 points moved so far.
std::optional<double> explainedShare(const std::vector<Vec3d>& points, const std::vector<Vec3d>& displacement,
                                     const openvdb::FloatGrid& phi);

// The mean weight of 0, 1/4, 1/2, 3/4, 1 that explains most, and how much: 1/2 where none explains more by
// half a percent.
struct FrameMotion {
  double meanWeight = 0.5;
  std::optional<double> explained;
};
FrameMotion bestMotion(const openvdb::FloatGrid& last, const openvdb::FloatGrid& phi,
                       const sim::FaceGrids& begin, const sim::FaceGrids& end, double seconds);

// The factor on velocities with which points end nearest to the surface, 1/300 to 300; nothing where too few
// points move. For velocities in another unit. residual: mean distance that is left, in cells.
struct VelocityFactor {
  double factor = 1.0, residual = 0.0, residualAsIs = 0.0, residualAtRest = 0.0;
};
std::optional<VelocityFactor> bestFactor(const openvdb::FloatGrid& last, const openvdb::FloatGrid& phi,
                                         const sim::FaceGrids& begin, const sim::FaceGrids& end,
                                         double meanWeight, double seconds);

}  // namespace fluidtex::caches
