// The last frame's mesh on a new level set, where it still fits.
#pragma once

#include "texture/levelset/isosurface.h"
#include "texture/mesh/editable_mesh.h"

#include <optional>

namespace fluidtex::texture {

// Number of vertices of a surface and area, component by component; component[v] is the smallest vertex of
// v's own.
struct Components {
  std::vector<std::uint32_t> component;  // #V
  struct Part {
    std::uint32_t first = 0;  // its smallest vertex
    long characteristic = 0;  // Euler's: V - E + T
    double area = 0.0;
  };
  std::vector<Part> parts;  // by first
};
Components componentsOf(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

// Whether both have equally many parts of each characteristic.
bool sameTopology(const Components& a, const Components& b);

// The mesh of `triangles` over `points` (index space), the points brought onto the level set. Nothing if it
// does not have the topology of the iso-surface, component by component, or if points have left the level
// set, or if it has folded or been stretched in many places: then it has to be made anew. `parts`: those of
// the iso-surface; `edge`: mean edge length of an even mesh at scale 1, voxels.
std::optional<EditableMesh> carriedMesh(const LevelSet& phi, const IsoSurface& surface,
                                        const Components& parts, const std::vector<Vec3f>& points,
                                        const std::vector<Vec3I>& triangles, float edge);

}  // namespace fluidtex::texture
