// A frame's texture on another mesh: that of [texture.onto], or the one that the liquid came as.
#pragma once

#include "caches/liquid/read_frame.h"
#include "sim/options.h"
#include "texture/surface.h"

namespace fluidtex::tools {

// Reads the frame's file (frames count from 1) and transfers the surface's maps to it. Polygons are
// fan-triangulated from their first corner; vertices keep their order. symmetry: of the exemplar. Throws
// sim::MeshError.
texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, const sim::MeshSequence& meshes,
                                  int frame, int symmetry);

// The same for the mesh that a liquid came as: vertex for vertex, with its own attributes.
texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, caches::CachedMesh mesh,
                                  int symmetry);

}  // namespace fluidtex::tools
