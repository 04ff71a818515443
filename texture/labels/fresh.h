// Fresh surface, whose transported texture has low trust, and droplets, too small to be textured.
#pragma once

#include "texture/mesh/vertex_graph.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Transported values of less trust are not used.
inline constexpr float kLowTrust = 0.3f;

// #V, 1 where trust (#V) is low: newly exposed surface.
std::vector<std::uint8_t> freshVertices(const std::vector<float>& trust);

// #V, 1 on connected pieces of `fresh` (#V) into which a window of `window` pixels fits: a vertex is window /
// 2 rings from the piece's rim, or the piece has no rim and as many vertices as the window has pixels. Such
// pieces are textured coarse to fine; narrower ones are found from what lies beside them.
std::vector<std::uint8_t> wideFresh(const VertexGraph& graph, const std::vector<std::uint8_t>& fresh,
                                    int window);

// #V, 1 on droplets: components with fewer vertices than a window has pixels, on which it would overlap
// itself.
std::vector<std::uint8_t> droplets(const VertexGraph& graph, int window);

// Replaces the gradients of droplets by the nearest unstretched ones (rotated, and mirrored where `ways`
// allows); coordinates stay. Droplets are never renewed, so their gradients would deform without bound.
// Precondition: `mesh` is oriented.
void calmDroplets(const SurfaceMesh& mesh, const std::vector<std::uint8_t>& droplets, const Ways& ways,
                  Carried& carried);

// Whether any entry is set.
bool any(const std::vector<std::uint8_t>& mask);

}  // namespace fluidtex::texture
