// Surfaces of the benchmarks of surface preparation: level sets before and after one frame, and the motion
// between them.
#pragma once

#include "texture/surface.h"

#include <openvdb/openvdb.h>

#include <functional>
#include <string>
#include <vector>

namespace fluidtex::benchmarks {

struct MovingSurface {
  openvdb::FloatGrid::ConstPtr before, now;  // metres, negative inside
  double spacing = 0.0;  // metres; one voxel, at which `now` has about the points asked for
  std::function<std::vector<texture::Vec3f>(const std::vector<texture::Vec3f>&)> moved;  // from before to now
};

// By name, with about `points` points of one voxel's spacing (a dam break: of whatever that resolution
// gives):
//  sphere         in the first 24th of a second of LeVeque's deformation [Enright02, radius 0.15]
//  torus          in the same flow
//  stretched      that sphere over the 24th of a second before it is most stretched, t = 1.5
//  drops_apart    two drops that fly at each other, just before they merge; drops_merged: just after
//  river          a wavy sheet that flows out of the box that cuts it
//  dam_break      frame 30 of the closed dam break
MovingSurface movingSurface(const std::string& name, int points);

}  // namespace fluidtex::benchmarks
