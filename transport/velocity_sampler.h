// Trilinear velocity and velocity gradient from the staggered grids of one substep.
#pragma once

#include "sim/frame.h"

#include <array>

namespace fluidtex::transport {

using openvdb::Mat3d;
using openvdb::Vec3d;

struct VelocitySample {
  Vec3d velocity{0.0};  // m/s
  // gradient[i][j] = d u_i / d x_j, 1/s, by the difference of the interpolated velocity over a voxel along
  // x_j: continuous and second order, as the slope within a cell is not. Only where asked for.
  Mat3d gradient;
  double known = 0.0;  // share of the values around that are active in their grid, 0..1
};

// Reads the grids in place, each component through its own transform, leaf by leaf. Where some of the values
// around a position are inactive the mean of the others stands for them; where all are, the velocity is zero.
// Remembers the last leaves, so that neighbouring positions are cheap: make one for each thread.
class VelocitySampler {
 public:
  // Throws std::invalid_argument if a grid's transform is not a scaling (one factor per axis) and a shift.
  // A grid that is null counts as inactive everywhere.
  explicit VelocitySampler(const sim::Substep& substep);

  VelocitySample velocity(const Vec3d& x);
  VelocitySample velocityAndGradient(const Vec3d& x);

  double voxelSize() const {
    return m_voxelSize;
  }  // smallest over axes and components, metres; 0 without grids

 private:
  using Leaf = sim::FloatTree::LeafNodeType;
  // A leaf and its 26 neighbours, looked up as they are needed: [9 x + 3 y + z], the middle one is 13.
  struct Leaves {
    openvdb::Coord origin = openvdb::Coord::max();  // of the middle one
    std::array<const Leaf*, 27> leaf{};
    std::array<const float*, 27> values{};
    std::uint32_t fetched = 0;  // bit i: leaf[i] has been looked up
  };
  struct Component {
    sim::FloatGrid::ConstPtr grid;
    std::unique_ptr<sim::FloatGrid::ConstAccessor> accessor;
    Vec3d scale{0.0}, shift{0.0};  // index = scale * x + shift
    Leaves near;
  };

  static void fetch(Component& component, unsigned which);
  static bool value(Component& component, unsigned which, unsigned offset, double& result);
  // The eight values around, [4 dx + 2 dy + dz]; the same bit of the result is set where the value is active.
  static unsigned valuesAround(Component& component, const openvdb::Coord& lower,
                               std::array<double, 8>& values);
  template <int kAxis>
  static bool valuesBeside(Component& component, const openvdb::Coord& lower, int step,
                           std::array<double, 4>& values);
  static Vec3d slopes(Component& component, const openvdb::Coord& lower, const std::array<double, 8>& values,
                      const Vec3d& t);
  template <bool kGradient>
  static double sampleComponent(Component& component, const Vec3d& x, double& value, Vec3d& gradient);
  template <bool kGradient>
  VelocitySample sample(const Vec3d& x);

  std::array<Component, 3> m_components;
  double m_voxelSize = 0.0;
};

}  // namespace fluidtex::transport
