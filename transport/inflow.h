// Surface through which liquid passes: where a source, a slit or an open side of the domain gives out liquid,
// the path of a vertex leads back to where there was no surface. Its texture is drawn out from beside it, as
// from a roll; where the flow goes through a surface that stays, the texture stays too.
#pragma once

#include "texture/joints/places.h"
#include "texture/surface.h"
#include "transport/pick_up.h"

#include <cstdint>
#include <vector>

namespace fluidtex::transport {

// A vertex of the new surface, traced back to the start of the frame.
struct TracedVertex {
  Vec3d position, origin;  // metres
  Vec3f normal;            // unit, of the new surface
  Vec3f carriedNormal;     // unit, the same at the origin
  double spacing = 0.0;    // metres, there
};

// What has come in since the last frame, along the surface.
enum class Inflow : std::uint8_t {
  none,
  // The flow enters the old liquid at the landing, through the rim of it; no inflow unless there is some
  // beside it.
  rim,
  // The origin lies upstream of the end of the old surface, outside of the liquid, by more than a quarter of
  // the spacing in the plane of the carried normal, and no farther than the vertex has moved.
  out
};

// landing: of the origin.
Inflow inflowAt(const TracedVertex& vertex, const Landing& landing);

// Whether the vertex moves across the surface (30 degrees or more), and the surface has not moved with it, so
// that the origin is off it by more than a quarter of the spacing.
// landing: of the origin.
bool goesThrough(const TracedVertex& vertex, const Landing& landing);

// Whether the surface was where the vertex is: nearer than a quarter of what the flow has moved across it.
// Where both are off, as in a splash, nothing has stayed.
// here: the landing of the vertex's own place.
bool hasStayed(const TracedVertex& vertex, const Landing& here);

// Continues the orientation and the exemplar coordinates (and those that fade) of vertices that ride with the
// flow, which are neither `out` nor `stays` (#V) nor of low trust, over those that are `out`, ring by ring,
// by their gradient: each vertex those of its neighbour in the largest piece of texture, counted by what of
// it lies upright (carried.orientation, symmetry as carry() has it), so that joints do not go on for ever.
// Across the direction of `way` (#V, metres: how the vertex has moved) the gradient is kept; along it the
// texture is laid anew at one texel per spacing, since what comes out has not been strained yet. What is
// reached has age 0 and the trust of where it comes from. Preconditions: unit normals; a closed, manifold
// mesh.
void drawOut(const texture::SurfaceMesh& mesh, const texture::Torus& torus, const std::vector<Inflow>& inflow,
             const std::vector<Vec3f>& way, int symmetry, texture::Carried& carried);

}  // namespace fluidtex::transport
