// Texture on surface that liquid flows out of or through. At a source, a slit or an open side of the domain,
// the back-trace of a vertex leaves the old surface: there the texture is extrapolated from that beside it.
// Where the flow crosses a surface that does not move, the surface keeps its texture.
#pragma once

#include "texture/joints/places.h"
#include "texture/mesh/vertex_graph.h"
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

// Whether new surface has come in along the surface since the last frame, at a vertex.
enum class Inflow : std::uint8_t {
  none,
  // At the landing the displacement points more into the old liquid than at the vertex: its component along
  // the outward normal is lower by more than 0.15 of its length. Counts only near vertices that are `out`.
  rim,
  // The origin lies off the old surface, upstream of the landing (within 45 degrees): by more than a quarter
  // of the spacing in the plane of the carried normal, by at most 1.25 times the way moved, and not deeper in
  // the liquid than a quarter of its distance or of the spacing, whichever is larger.
  out
};

// landing: of the origin.
Inflow inflowAt(const TracedVertex& vertex, const Landing& landing);

// Whether the vertex moves across the surface, at 30 degrees or more to it, and the surface has not moved
// with it: the origin is off the old surface by at least a quarter of the spacing, and either by more than
// half of the motion across the surface, or the normals there differ by more than 60 degrees. landing: of the
// origin.
bool goesThrough(const TracedVertex& vertex, const Landing& landing);

// Whether the surface was where the vertex is: nearer than a quarter of what the flow has moved across it.
// Where both are off, as in a splash, nothing has stayed.
// here: the landing of the vertex's own place.
bool hasStayed(const TracedVertex& vertex, const Landing& here);

// Whether one of them is `out`.
bool anyOut(const std::vector<Inflow>& inflow);

// Extrapolates orientation, exemplar coordinates and cross-fade (`carried`) to vertices that are `out`, and
// to `rim` vertices within four rings of these. Sources are all other vertices, except those that stay
// (carried.stays) and those of trust below kLowTrust. Ring by ring, each vertex continues the values of one
// neighbour by their gradient: the neighbour whose patch has the most vertices at which the texture is
// aligned with carried.orientation, within 20 degrees and up to rotations by 360 / symmetry degrees; of
// several the nearest. So misaligned patches do not spread. Across `way` (#V, metres: displacement in the
// frame) the gradient is kept; along it the texture gets one texel per spacing, since new surface has not
// been strained yet. Extrapolated vertices get age 0 and the trust of that neighbour. Preconditions: unit
// normals; `graph` is the mesh's wherever anyOut().
void drawOut(const texture::SurfaceMesh& mesh, const texture::VertexGraph& graph, const texture::Torus& torus,
             const std::vector<Inflow>& inflow, const std::vector<Vec3f>& way, int symmetry,
             texture::Carried& carried);

}  // namespace fluidtex::transport
