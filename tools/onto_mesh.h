// A frame's texture on the mesh that the scene names in [texture.onto].
#pragma once

#include "sim/options.h"
#include "texture/surface.h"

namespace fluidtex::tools {

// Reads the frame's file (frames count from 1) and brings the surface's maps onto it. Polygons are cut into
// triangles from their first corner; vertices keep their order. `symmetry` is that of the exemplar. Throws
// sim::MeshError.
texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, const sim::MeshSequence& meshes,
                                  int frame, int symmetry);

}  // namespace fluidtex::tools
