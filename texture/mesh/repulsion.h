// Repulsion between the vertices of a mesh, restricted to a level set [Turk91].
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Range of repulsion, mean edge lengths: beyond it Delaunay flips change neighbours, and the force must not
// jump.
inline constexpr float kRepulsionRange = 1.25f;
inline constexpr float kLongestMove = 0.25f;  // per sweep, mean edge lengths

// Jacobi repulsion of a mesh's vertices, sweep by sweep. Keeps references; the mesh may change between
// sweeps.
class Repulsion {
 public:
  // edge: voxels, mean edge length of the even mesh at scale 1.
  Repulsion(EditableMesh& mesh, const LevelSet& phi, float edge) : m_mesh(mesh), m_phi(phi), m_edge(edge) {}

  // #V: out of balance, moving.
  std::vector<std::uint8_t> awake;

  // One sweep: vertices in `active` that are awake, or whose displacement exceeds `wake`, move at once, where
  // that folds no triangle. `active` becomes the list of those that moved by more than `sleep`; the others
  // fall asleep. Thresholds in local mean edge lengths.
  void sweep(std::vector<std::uint32_t>& active, float wake, float sleep);

 private:
  Vec3f push(std::uint32_t v) const;
  bool revertFolds(const std::vector<std::uint32_t>& movers);

  EditableMesh& m_mesh;
  const LevelSet& m_phi;
  float m_edge;
  std::vector<Vec3f> m_position, m_normal;  // #movers: before the sweep
  std::vector<Vec3f> m_last;                // #V: the last sweep's move
  std::vector<std::uint8_t> m_undo;         // #V, 0 between sweeps
};

}  // namespace fluidtex::texture
