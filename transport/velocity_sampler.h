// Trilinear velocity and velocity gradient from the staggered grids of one substep.
#pragma once

#include "sim/frame/frame.h"

#include <array>
#include <optional>
#include <vector>

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec3d;

struct VelocitySample {
  Vec3d velocity{0.0};  // m/s
  // gradient[i][j] = d u_i / d x_j, 1/s, by the difference of the interpolated velocity over a voxel along
  // x_j: continuous and second order, as the slope within a cell is not. Only where asked for.
  Mat3d gradient;
  double known = 0.0;  // share of the values around that are known, 0..1
};

// Reads the grids in place, each component through its own transform. A value is known where it is active and
// finite. Where some of the values around a position are unknown the mean of the others stands for them;
// where all are, the velocity is zero. Make one for each thread.
class VelocitySampler {
 public:
  // Throws std::invalid_argument if a grid's transform is not a scaling (one factor per axis) and a shift.
  // A grid that is null counts as unknown everywhere.
  explicit VelocitySampler(const sim::Substep& substep);

  // Lays the values that positions in the box (metres) need side by side, so that reading there costs a
  // third; worth it where there are many. It replaces the last box, and changes no sample by a bit.
  void focus(const Vec3d& lower, const Vec3d& upper);

  VelocitySample velocity(const Vec3d& x);
  VelocitySample velocityAndGradient(const Vec3d& x);

  double voxelSize() const {
    return m_voxelSize;
  }  // smallest over axes and components, metres; 0 without grids

 private:
  // Values of a box, those that are unknown as NaN.
  struct Window {
    openvdb::Coord origin{0}, size{0};  // first voxel; voxels along each axis
    std::vector<float> values;          // z fastest
  };
  struct Component {
    sim::FloatGrid::ConstPtr grid;
    std::optional<sim::FloatGrid::ConstUnsafeAccessor> accessor;
    Vec3d scale{0.0}, shift{0.0};  // index = scale * x + shift
    Window window;
  };

  static void fill(Component& component);
  template <bool kGradient>
  static double sampleComponent(Component& component, const Vec3d& x, double& value, Vec3d& gradient);
  template <bool kGradient>
  VelocitySample sample(const Vec3d& x);

  std::array<Component, 3> m_components;
  double m_voxelSize = 0.0;
};

}  // namespace fluidtex::transport
