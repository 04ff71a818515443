// Where a new surface has no texture yet that could be believed, and where it is too small to need any.
#pragma once

#include "texture/options.h"
#include "texture/orientation/tangent.h"
#include "texture/surface.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// What was carried with less trust than this is as good as nothing.
inline constexpr float kLowTrust = 0.3f;

// #V, 1 where the trust (#V) is low: surface that has just come to light.
std::vector<std::uint8_t> freshVertices(const std::vector<float>& trust);

// The connected pieces of `fresh` (#V) into which a window of `window` pixels fits: 1 at all vertices of a
// piece one of whose vertices is window / 2 rings away from all that is not fresh, or which has no rim at all
// and as many vertices as the window has pixels. There a texture has to be found coarse to fine, while
// narrower pieces are found from what lies beside them. All 0 where there is none.
std::vector<std::uint8_t> wideFresh(const VertexGraph& graph, const std::vector<std::uint8_t>& fresh,
                                    int window);

// #V, 1 at the vertices of droplets: components with fewer vertices than a window has pixels, on which it
// would overlap itself.
std::vector<std::uint8_t> droplets(const VertexGraph& graph, int window);

// Texture on droplets is never renewed, so that the flow would deform it without an end, and within some
// frames no coordinate beside a vertex could be foretold from the vertex's own. There each keeps its
// coordinate, with a gradient that lies unstretched, turned and, where `ways` allow it, mirrored as the
// carried one is. `mesh` must be oriented.
void calmDroplets(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& droplets, const Ways& ways,
                  Carried& carried);

// Whether any entry is set.
bool any(const std::vector<std::uint8_t>& mask);

}  // namespace fluidtex::texture
