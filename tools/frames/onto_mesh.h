// A frame's texture on the mesh of [texture.onto].
#pragma once

#include "sim/options.h"
#include "texture/surface.h"

namespace fluidtex::tools {

// Reads the frame's file (frames count from 1) and transfers the surface's maps to it. Polygons are
// fan-triangulated from their first corner; vertices keep their order. symmetry: of the exemplar. Throws
// sim::MeshError.
texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, const sim::MeshSequence& meshes,
                                  int frame, int symmetry);

}  // namespace fluidtex::tools
