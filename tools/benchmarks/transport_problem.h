// What transport is measured on: a textured sphere in LeVeque's deformation, and the mesh that its texture is
// carried to.
#pragma once

#include "sim/frame/frame.h"
#include "texture/surface.h"

namespace fluidtex::benchmarks {

inline constexpr int kTransportSubsteps = 4;

struct TransportProblem {
  texture::TexturedSurface previous;
  sim::Frame frame;           // kTransportSubsteps of them, in the cells around the surface
  texture::SurfaceMesh next;  // its vertices lie some way off those that have moved
};

// points: about how many vertices; cells as wide as their spacing.
TransportProblem transportProblem(int points);

}  // namespace fluidtex::benchmarks
