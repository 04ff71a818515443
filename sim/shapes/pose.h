// Pose and motion of a solid at a time.
#pragma once

#include "sim/options.h"

#include <openvdb/math/BBox.h>

namespace fluidtex::sim {

// Turned by `angle` (radians) about the axis through `pivot`, then moved by `move` (metres); velocities are
// `speed` (m/s) and `spin` (radians/s). Before that, a mesh sequence is at the fraction `part` (0 to 1) from
// its file number `file`, counted from 0, to the next, and advances by `fileRate` files a second.
struct Pose {
  Vec3d pivot{0.0}, axis{0.0, 0.0, 1.0}, move{0.0};
  double angle = 0.0;
  Vec3d speed{0.0};
  double spin = 0.0;
  int file = 0;
  double part = 0.0, fileRate = 0.0;

  bool operator==(const Pose&) const = default;
  bool moving() const { return spin != 0.0 || fileRate != 0.0 || speed != Vec3d(0.0); }

  // From the shape's own place to the world, and back.
  Vec3d toWorld(const Vec3d& x) const;
  Vec3d toBody(const Vec3d& x) const;

  // The same for a direction.
  Vec3d directionToWorld(const Vec3d& v) const;

  // Velocity of the solid at world position x, m/s, without the change of its shape.
  Vec3d velocityAt(const Vec3d& x) const;
};

// Bounds after the motion of what is within these bounds before it. Where it turns, infinite if they are.
openvdb::math::BBox<Vec3d> boundsAt(const openvdb::math::BBox<Vec3d>& bounds, const Pose& pose);

// Bounds of the part of a solid's shape, before it is moved, that gets into the box at any time; not always
// the smallest.
openvdb::math::BBox<Vec3d> reachOf(const Solid& solid, const openvdb::math::BBox<Vec3d>& box);

// The pose at time t. At a keyframe, and at the time of a sequence's file, the velocities are those after it.
Pose poseAt(const Solid& solid, double t);

}  // namespace fluidtex::sim
