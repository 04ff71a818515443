// Meshes with texture coordinates (UV).
#pragma once

#include "sim/meshes/read_mesh.h"

#include <vector>

namespace fluidtex::sim {

// Triangles, each with corners of its own, in the world.
struct UvMesh {
  std::vector<openvdb::Vec3f> positions;  // 3 #T, metres
  std::vector<openvdb::Vec2f> uv;  // 3 #T: u to the right, v up from the lowest row, 0..1 over the picture
};

// Reads the faces of an OBJ that have texture coordinates, split into triangles; those without are left out.
// Coordinates beyond 0..1 are of a picture that is repeated: each triangle is moved by whole pictures, so
// that its middle lies on the picture. Where the mesh encloses a negative volume, all triangles are turned
// round. Throws MeshError; also where no face has texture coordinates.
UvMesh readUvMesh(const MeshShape& shape);

}  // namespace fluidtex::sim
