// The surface of a mesh sequence at any time.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/shapes/shape_distance.h"

#include <vector>

namespace fluidtex::sim {

// The files of a sequence as one closed triangle mesh whose vertices move. Polygons are split into triangles,
// and vertices that coincide in all files are joined, the same way in each of them. Takes 12 bytes a vertex
// and file.
class MovingMesh {
 public:
  // Reads all files, or those from `begin` to `end`, counted from 0. Throws MeshError, as readMesh does, and
  // where two files differ in their vertices or faces.
  explicit MovingMesh(const MeshSequence& sequence);
  MovingMesh(const MeshSequence& sequence, int begin, int end);

  // The mesh at the fraction `part` (0 to 1) from a file to the next.
  TriangleMesh at(int file, double part) const;

  // Displacement of each vertex from the file to the next; #V, metres.
  std::vector<openvdb::Vec3f> change(int file) const;

 private:
  int m_begin;
  std::vector<std::vector<openvdb::Vec3f>> m_positions;  // of each file; #V, metres
  std::vector<openvdb::Vec3I> m_triangles;
};

}  // namespace fluidtex::sim
