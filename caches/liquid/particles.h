// Surface of particles.
#pragma once

#include "caches/liquid/surface_mesh.h"

namespace fluidtex::caches {

// Mean distance between neighbours: cube root of the volume that a particle has inside the liquid, by the
// density (smoothed over three spacings) that a fifth of them exceed, so that it holds for lattices and for
// particles in disorder. 0 for fewer than two, or where all are in one place.
double particleSpacing(const std::vector<openvdb::Vec3f>& points);

// The surface around the particles, half a spacing outside of the outermost, where the liquid ends that each
// stands for: where the mean place of those around is as far as it is from a flat surface (Zhu and Bridson
// 2005, "Animating sand as a fluid", section 4), and a particle is near. spacing: twice the particles'
// radius. In the particles' unit.
SurfaceTriangles surfaceOfParticles(const std::vector<openvdb::Vec3f>& points, double spacing);

}  // namespace fluidtex::caches
