// Velocity of particles.
#pragma once

#include <openvdb/openvdb.h>

#include <vector>

namespace fluidtex::caches {

// Velocity at each voxel of side `spacing` that has particles around it, and three layers beyond: the value
// of the linear field that fits theirs best (moving least squares; Lancaster and Salkauskas 1981). How far
// its slope leads from their mean is drawn in by what chance makes of such slopes: all of it where velocities
// are linear, nothing of it where those of a splash cross. velocity: #P x 3, all finite.
openvdb::Vec3SGrid::Ptr velocityOfParticles(const std::vector<openvdb::Vec3f>& points,
                                            const std::vector<float>& velocity, double spacing);

}  // namespace fluidtex::caches
