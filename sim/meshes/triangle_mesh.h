// Triangles that share vertices.
#pragma once

#include <openvdb/Types.h>

#include <vector>

namespace fluidtex::sim {

struct TriangleMesh {
  std::vector<openvdb::Vec3f> positions;  // #V, metres
  std::vector<openvdb::Vec3I> triangles;  // #T, counter-clockwise from outside
};

}  // namespace fluidtex::sim
