// Repulsion between the vertices of a mesh, restricted to a level set [Turk91].
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

// Neighbours repel up to so many mean edge lengths: beyond it a Delaunay flip turns edges, and no force may
// jump there.
inline constexpr float kRepulsionRange = 1.25f;
inline constexpr float kLongestMove = 0.25f;  // in one sweep, mean edge lengths

// Moves vertices away from their neighbours, sweep by sweep. What it works on stays outside: `mesh` may
// change between sweeps.
class Repulsion {
 public:
  // `edge`: voxels, the mean length of the even mesh's edges, at scale 1.
  Repulsion(EditableMesh& mesh, const LevelSet& phi, float edge) : m_mesh(mesh), m_phi(phi), m_edge(edge) {}

  // #V: out of balance, moving.
  std::vector<std::uint8_t> awake;

  // One sweep: the vertices in `active` that are awake, or whose push is larger than `wake`, move at once,
  // where that folds no triangle. Leaves in `active` those that moved by more than `sleep`; the others go to
  // sleep where they were. Both in mean edge lengths there.
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
