// Folds and spikes of a mesh.
#pragma once

#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Area-weighted normal of the triangles around a vertex, unit; zero where they cancel.
Vec3f meshNormal(const EditableMesh& mesh, std::uint32_t v);

// The stored normal of the level set, or meshNormal() where it is zero or deviates much: on rims, and in
// films thinner than the mesh can follow.
Vec3f normalAt(const EditableMesh& mesh, std::uint32_t v);

struct Ring {
  openvdb::Vec3d toMean{0.0};  // from the vertex to the mean of its neighbours
  double edge = 0.0;           // mean length
  int count = 0;
};
Ring ringOf(const EditableMesh& mesh, std::uint32_t v);

// Cosine of the angle between the normals of an edge's triangles; -1 where one is degenerate.
double turn(const EditableMesh& mesh, std::uint32_t h);

// Slightly stricter than MeshStats::folded and spikes, since positions are rounded once more.
inline constexpr double kFolded = 0.03;  // edges of smaller turn() are folds
inline constexpr double kSpike = 0.48;   // in mean edges: distance from the neighbours' mean along the normal

bool sticksOut(const EditableMesh& mesh, std::uint32_t v);

struct Faults {
  std::vector<std::uint32_t> folds;   // one half-edge per edge
  std::vector<std::uint32_t> spikes;  // vertices
  bool none() const { return folds.empty() && spikes.empty(); }
};

// Faults of the whole mesh, or at some vertices and at the edges from them to vertices of higher index.
// Removed vertices have none.
Faults faultsOf(const EditableMesh& mesh);
Faults faultsAt(const EditableMesh& mesh, const std::vector<std::uint32_t>& vertices);

}  // namespace fluidtex::texture
