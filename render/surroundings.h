// Surroundings of the liquid: the ground, and rods along the edges of the tank.
#pragma once

#include "render/mesh.h"
#include "render/options.h"

namespace fluidtex::render {

// The ground is a wide square that fades out between these distances from the centre of the domain, in
// diagonals of the domain, so that the picture has no hard horizon.
inline constexpr float kGroundFadeFrom = 1.5f, kGroundFadeTo = 7.0f;

// Opacity of the ground at distance `distance` (in diagonals) from the centre of the domain: 1 near, 0 far.
inline float groundOpacity(float distance) {
  return 1.0f - smoothStep(kGroundFadeFrom, kGroundFadeTo, distance);
}

// Meshes around the domain [0, domainSize], as the settings say. The ground lies just below z = 0, the rods
// just outside the domain, so that they never intersect the liquid.
std::vector<Mesh> surroundingMeshes(const Surroundings& surroundings, const Vec3d& domainSize);

}  // namespace fluidtex::render
