// A picture of a mesh: its triangles, edges and vertices.
#pragma once

#include "texture/surface.h"

#include <filesystem>

namespace fluidtex::benchmarks {

// Orthographic, seen from above the front right corner, in the format that the file's name tells. `zoom`: 1
// shows the whole mesh, 2 the half of its middle in each direction. Throws std::runtime_error where the file
// cannot be written.
void drawMesh(const texture::SurfaceMesh& mesh, double zoom, const std::filesystem::path& file);

}  // namespace fluidtex::benchmarks
