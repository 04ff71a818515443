// A textured surface as few bytes, for the page (tools/report/page/packed_mesh.js).
#pragma once

#include "texture/surface.h"

#include <string>

namespace fluidtex::tools {

// Little endian:
//   uint32   vertices, indices (3 a triangle), bytes of the vertices, bytes of the indices
//   float32  lowest corner x y z (m), step of the positions (m), largest age (s), largest speed (m/s)
//   vertices, 16 bytes each:
//     uint16  x y z in steps from the lowest corner; 0
//     uint8   red green blue alpha (sRGB); age over the largest, trust, speed over the largest (255 is 1); 0
//   indices
// Vertices and indices by the codec of meshoptimizer (vertex format 0, index format 1). A mesh that has more
// than mostTriangles is thinned to about so many, and not more, by edge collapses.
std::string packMesh(const texture::TexturedSurface& surface, std::size_t mostTriangles);

}  // namespace fluidtex::tools
