// Reuses the last frame's mesh on a new level set, where it fits.
#pragma once

#include "texture/levelset/isosurface.h"
#include "texture/mesh/editable_mesh.h"

#include <optional>

namespace fluidtex::texture {

// Connected components of a surface. component[v] is the smallest vertex of v's component.
struct Components {
  std::vector<std::uint32_t> component;  // #V
  struct Part {
    std::uint32_t first = 0;  // its smallest vertex
    long characteristic = 0;  // Euler characteristic V - E + T
    double area = 0.0;
  };
  std::vector<Part> parts;  // by first
};
Components componentsOf(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

// Whether both have equally many components of each characteristic.
bool sameTopology(const Components& a, const Components& b);

// The mesh of `triangles` over `points` (index space), projected onto the level set. Nothing if it differs in
// topology from the iso-surface, component by component, if points are off the level set, or if it is folded
// or stretched in many places: then it must be remade. parts: components of the iso-surface. edge: mean edge
// length of an even mesh at scale 1, voxels.
std::optional<EditableMesh> carriedMesh(const LevelSet& phi, const IsoSurface& surface,
                                        const Components& parts, const std::vector<Vec3f>& points,
                                        const std::vector<Vec3I>& triangles, float edge);

}  // namespace fluidtex::texture
