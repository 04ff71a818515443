// Paths through the substeps of a frame: where a point was, and how the flow deformed what lies around it.
#pragma once

#include "sim/frame/frame.h"

#include <vector>

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

// #V each.
struct Backtrace {
  std::vector<Vec3d> origin;  // where the point was at the start of the frame, metres
  std::vector<Mat3d> map;     // B = d origin / d position, B[i][j] = d origin_i / d position_j
  std::vector<float> known;   // share of the path along which the velocity is known, 0..1
};

// Follows positions at the end of the frame back to its start: third-order Runge-Kutta through each substep's
// velocity, constant in time, the last substep first. B follows the velocity's gradient along that path,
// taken over a voxel (VelocitySample): the slope of the interpolated velocity itself jumps from cell to cell.
// One inner step moves a point by about one cell at most, unless a substep would need more than 64 of them.
Backtrace traceBack(const std::vector<Vec3f>& positions, const sim::Frame& frame);

// Positions at the start of the frame, followed forward to its end.
std::vector<Vec3f> traceForward(const std::vector<Vec3f>& positions, const sim::Frame& frame);

}  // namespace fluidtex::transport
