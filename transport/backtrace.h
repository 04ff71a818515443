// Back-trace: where points were at the start of a frame, and how the flow deformed their surroundings.
#pragma once

#include "sim/frame/frame.h"

#include <vector>

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Result per point (#V each).
struct Backtrace {
  std::vector<Vec3d> origin;  // position at the start of the frame, metres
  std::vector<Mat3d> map;     // B = d origin / d position, B[i][j] = d origin_i / d position_j
  std::vector<float> known;   // share of the path along which the velocity is known, 0..1
};

// Traces positions (metres) at the end of the frame back to its start: third-order Runge-Kutta through each
// substep's velocity, constant in time, the last substep first. B follows the velocity gradient along the
// path, taken over a voxel (VelocitySample), since the slope of the interpolated velocity jumps from cell to
// cell. An inner step moves a point by about one cell at most, unless a substep needed more than 64 of them.
Backtrace traceBack(const std::vector<Vec3f>& positions, const sim::Frame& frame);

// Traces positions (metres) at the start of the frame forward to its end.
std::vector<Vec3f> traceForward(const std::vector<Vec3f>& positions, const sim::Frame& frame);

}  // namespace fluidtex::transport
