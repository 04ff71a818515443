// Trilinear velocity and its gradient from the staggered grids of one substep.
#pragma once

#include "sim/frame/frame.h"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace fluidtex::transport {

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Vec3d;

struct VelocitySample {
  Vec3d velocity{0.0};  // m/s
  // gradient[i][j] = d u_i / d x_j, 1/s: difference of the interpolated velocity over a voxel along x_j,
  // continuous and second order, unlike the slope within a cell. Filled by velocityAndGradient() only.
  Mat3d gradient;
  double known = 0.0;  // share of the surrounding values that are known, 0..1
};

// The side of thin walls on which a place is.
struct WallSide {
  Coord cell{0};        // that holds the place, or the nearest one outside where its centre is in a solid
  bool walled = false;  // whether anything is hidden from it; otherwise the cell does not matter
};

// Reads the grids in place, each component through its own transform. A value is known where it is active and
// finite. Unknown values around a position are replaced by the mean of the known ones; if all are unknown,
// the velocity is zero. Places beside thin walls have the velocity of their own side
// (sim::Substep::visibility). One sampler per thread.
class VelocitySampler {
 public:
  // Throws std::invalid_argument if a grid's transform is not a scaling (one factor per axis) and a
  // translation. A null grid is unknown everywhere.
  explicit VelocitySampler(const sim::Substep& substep);

  // Copies the values needed in the box (metres) to dense arrays, which makes samples there three times as
  // fast; worth it for many samples. Replaces the last box. Samples are bitwise unchanged.
  void focus(const Vec3d& lower, const Vec3d& upper);

  VelocitySample velocity(const Vec3d& x) { return velocity(x, sideOf(x)); }
  VelocitySample velocityAndGradient(const Vec3d& x) { return velocityAndGradient(x, sideOf(x)); }

  WallSide sideOf(const Vec3d& x) { return m_visibility == nullptr ? WallSide{} : nearestOutside(x); }
  // On the side of a place no farther than a cell from x: where a wall hides x from it, x is read at the
  // wall.
  VelocitySample velocity(const Vec3d& x, const WallSide& side) {
    return side.walled ? besideWall(x, side) : sample<false>(x);
  }
  VelocitySample velocityAndGradient(const Vec3d& x, const WallSide& side) {
    return side.walled ? besideWallAndGradient(x, side) : sample<true>(x);
  }

  double voxelSize() const {
    return m_voxelSize;
  }  // smallest over axes and components, metres; 0 without grids

 private:
  // Dense copy of a box of values, unknown ones as NaN.
  struct Window {
    Coord origin{0}, size{0};   // first voxel; voxels along each axis
    std::vector<float> values;  // z fastest
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

  // A place in cells, from the lower corner of cell (0, 0, 0).
  Vec3d inCells(const Vec3d& x) const;
  // As Visibility::around(), which costs more.
  const sim::VisibleCells* around(const Coord& cell);
  WallSide nearestOutside(const Vec3d& x);
  VelocitySample besideWall(const Vec3d& x, const WallSide& side);
  VelocitySample besideWallAndGradient(const Vec3d& x, const WallSide& side);

  std::array<Component, 3> m_components;
  double m_voxelSize = 0.0;
  std::shared_ptr<const sim::Visibility> m_visibility;
  // The block last looked up; no block begins at the cell that this starts with.
  Coord m_block = Coord::max();
  const sim::Visibility::Leaf* m_leaf = nullptr;
};

}  // namespace fluidtex::transport
