// Orientation of the triangles of a closed mesh.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/vec3.h"

#include <optional>
#include <vector>

namespace fluidtex::sim {

// The triangles of a mesh without open edges, turned outward whatever their orientation: counter-clockwise
// from outside the solid. A part that lies within another one is the wall of a cavity, one within that a
// solid again; parts that cross or touch are one solid. Empty where a part is one-sided.
std::optional<std::vector<openvdb::Vec3I>> turnedOutward(const TriangleMesh& mesh);

}  // namespace fluidtex::sim
