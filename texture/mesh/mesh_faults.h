// Where a mesh is not fair: edges that fold, vertices that stick out.
#pragma once

#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// The mesh's own normal at a vertex: mean of its triangles', weighted by area. Zero where they cancel out.
Vec3f meshNormal(const EditableMesh& mesh, std::uint32_t v);

// The level set's normal that is stored, or the mesh's own where there is none or quite another one: on rims
// and in films thinner than the mesh can follow.
Vec3f normalAt(const EditableMesh& mesh, std::uint32_t v);

struct Ring {
  openvdb::Vec3d toMean{0.0};  // from the vertex to the mean of its neighbours
  double edge = 0.0;           // mean length
  int count = 0;
};
Ring ringOf(const EditableMesh& mesh, std::uint32_t v);

// Cosine of the angle between the normals of the two triangles of an edge; -1 where one has no area.
double turn(const EditableMesh& mesh, std::uint32_t h);

// A little less than what must not be (MeshStats::folded, spikes), since positions are rounded once more.
inline constexpr double kFolded = 0.03;  // smaller turns are faults
inline constexpr double kSpike = 0.48;   // mean edges from a vertex to its neighbours' mean, along its normal

bool sticksOut(const EditableMesh& mesh, std::uint32_t v);

struct Faults {
  std::vector<std::uint32_t> folds;   // half-edges, one of each two
  std::vector<std::uint32_t> spikes;  // vertices
  bool none() const { return folds.empty() && spikes.empty(); }
};

// Those of the whole mesh, or at some vertices and at the edges from them to vertices of higher number.
// Vertices that are gone have none.
Faults faultsOf(const EditableMesh& mesh);
Faults faultsAt(const EditableMesh& mesh, const std::vector<std::uint32_t>& vertices);

}  // namespace fluidtex::texture
