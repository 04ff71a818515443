// Surface and velocity of particles.
#pragma once

#include "caches/formats/geometry.h"
#include "caches/liquid/surface_mesh.h"

namespace fluidtex::caches {

// Mean distance between neighbours: cube root of the volume that a particle has inside the liquid, by the
// density (smoothed over three spacings) that a fifth of them exceed, so that it holds for lattices and for
// particles in disorder. 0 for fewer than two, or where all are in one place.
double particleSpacing(const std::vector<openvdb::Vec3f>& points);

// The surface of balls around the particles, smoothed, half a spacing outside of the outermost: where the
// liquid ends that each stands for. spacing: twice the particles' radius. In the particles' unit.
SurfaceTriangles surfaceOfParticles(const std::vector<openvdb::Vec3f>& points, double spacing);

// Velocity at each voxel of side `spacing` that has particles around it, by the linear field that fits theirs
// best, and three layers beyond. velocity: #P x 3, all finite.
openvdb::Vec3SGrid::Ptr velocityOfParticles(const std::vector<openvdb::Vec3f>& points,
                                            const std::vector<float>& velocity, double spacing);

}  // namespace fluidtex::caches
