// A textured surface cut along its joints, for formats and programs that know one texture coordinate a
// vertex.
#pragma once

#include "texture/surface.h"

#include <array>
#include <cstdint>

namespace fluidtex::texture {

// A vertex of a cut surface, as a mean of at most three vertices of the surface that was cut, corners of one
// triangle.
struct Origin {
  std::array<std::uint32_t, 3> vertex{};
  std::array<float, 3> weight{1.0f, 0.0f, 0.0f};  // 0 where there are fewer
};

// Triangles of one piece each, also of what fades; their corners' coordinates, in texels, can be
// interpolated. They are not brought back onto a toroidal exemplar, so that no triangle lies across its edge,
// and reach up to a triangle beyond the edge of one that is not.
struct CutSurface {
  TexturedSurface surface;
  std::vector<Origin> origin;  // of its vertices; the first ones are those of the surface that was cut
  std::vector<std::uint32_t> triangle;  // of its triangles: the triangle that each is a part of
};

// Edges between pieces (places.h) are cut at their middles, triangles of three pieces at their centroids too.
// Where two corners are of one piece with the third but not with each other, the triangle is halved.
// On a cut there is a vertex for each side. Of the side's own corner are coordinate and gradient, present and
// former, orientation, vector maps and contact; all else is interpolated. The surface stays the same set of
// points. Requires gradients; a surface without coordinates comes back uncut.
CutSurface cutAtJoints(const TexturedSurface& surface, bool toroidal);

}  // namespace fluidtex::texture
