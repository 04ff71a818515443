// Surface and velocity of particles.
#pragma once

#include "caches/formats/geometry.h"
#include "caches/liquid/surface_mesh.h"

namespace fluidtex::caches {

// Mean distance between neighbours: cube root of the volume a particle has where most of them are, so that it
// holds for lattices and for particles in disorder. 0 for fewer than two.
double particleSpacing(const std::vector<openvdb::Vec3f>& points);

// The surface of balls around the particles, smoothed, half a spacing outside of the outermost: where the
// liquid ends that each stands for. spacing: twice the particles' radius. In the particles' unit.
SurfaceTriangles surfaceOfParticles(const std::vector<openvdb::Vec3f>& points, double spacing);

// Mean velocity of the particles around each voxel of side `spacing`, weighted linearly, and three layers
// beyond. velocity: #P x 3.
openvdb::Vec3SGrid::Ptr velocityOfParticles(const std::vector<openvdb::Vec3f>& points,
                                            const std::vector<float>& velocity, double spacing);

}  // namespace fluidtex::caches
