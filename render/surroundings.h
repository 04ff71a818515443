// What stands around the liquid: the ground, and the rods that draw the edges of the tank.
#pragma once

#include "render/mesh.h"
#include "render/options.h"

namespace fluidtex::render {

// The ground is a wide square that fades into the horizon between these distances from the middle of the
// domain, in diagonals of the domain. So the picture has no hard horizon.
inline constexpr float kGroundFadeFrom = 1.5f, kGroundFadeTo = 7.0f;

// How much of the ground is seen at distance `distance` (in diagonals) from the middle of the domain: 1 near,
// 0 far.
inline float groundOpacity(float distance) {
  return 1.0f - smoothStep(kGroundFadeFrom, kGroundFadeTo, distance);
}

// Meshes around the domain [0, domainSize], as the settings ask. The ground lies just below z = 0; the rods
// lie just outside the domain, so that they never cut into the liquid.
std::vector<Mesh> surroundingMeshes(const Surroundings& surroundings, const Vec3d& domainSize);

}  // namespace fluidtex::render
