// Where a solid is at a time, and how it moves there.
#pragma once

#include "sim/options.h"

#include <openvdb/math/BBox.h>

namespace fluidtex::sim {

// Turned by `angle` (radians) about the axis through `pivot`, then moved by `move` (metres); goes on at
// `speed` (m/s) and `spin` (radians/s). A mesh sequence is before that as far as `part` (0 to 1) on the way
// from its file number `file`, counted from 0, to the next, and goes on by `fileRate` files a second.
struct Pose {
  Vec3d pivot{0.0}, axis{0.0, 0.0, 1.0}, move{0.0};
  double angle = 0.0;
  Vec3d speed{0.0};
  double spin = 0.0;
  int file = 0;
  double part = 0.0, fileRate = 0.0;

  bool operator==(const Pose&) const = default;
  bool moving() const { return spin != 0.0 || fileRate != 0.0 || speed != Vec3d(0.0); }

  // From where the shape was made to the world, and back.
  Vec3d toWorld(const Vec3d& x) const;
  Vec3d toBody(const Vec3d& x) const;

  // The same of a direction.
  Vec3d directionToWorld(const Vec3d& v) const;

  // m/s, of the solid's matter at world position x, but for the change of its shape.
  Vec3d velocityAt(const Vec3d& x) const;
};

// Of what is within these bounds before it is moved. Turned, it is infinite if they are anywhere.
openvdb::math::BBox<Vec3d> boundsAt(const openvdb::math::BBox<Vec3d>& bounds, const Pose& pose);

// Where a solid's shape, before it is moved, gets into the box at any time; not always the smallest.
openvdb::math::BBox<Vec3d> reachOf(const Solid& solid, const openvdb::math::BBox<Vec3d>& box);

// The pose at time t; at a keyframe, and at the time of a sequence's file, it goes on as after it.
Pose poseAt(const Solid& solid, double t);

}  // namespace fluidtex::sim
