// Operations that even out a mesh on a level set: Delaunay flips, splits, collapses, repulsion.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"
#include "texture/mesh/patches.h"

#include <algorithm>

namespace fluidtex::texture {

// Mean edge length of an even mesh that has one vertex per unit square.
inline constexpr float kEdgePerSpacing = 1.0746f;

// Smallest cosine between a triangle's normal and the level set's normals at its corners; -1 if degenerate.
float facing(const Vec3f (&p)[3], const Vec3f (&n)[3]);

// Least cosine of a triangle that faces outwards. No operation may go below it, unless there was a worse
// triangle before: mayFace(now, before).
inline constexpr float kFacing = 0.1f;
inline bool mayFace(float now, float before) {
  return now >= kFacing || now >= before;
}

// Whether the triangle's facing() is at least kFacing.
bool facesOutward(const EditableMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c);

// Smallest facing() of the triangles around v, without those that also touch `except`.
float worstFacing(const EditableMesh& mesh, std::uint32_t v, std::uint32_t except = kNone);

// The same if v were at `at`.
float worstFacingAt(const EditableMesh& mesh, std::uint32_t v, const Vec3f& at, const Vec3f& atNormal,
                    std::uint32_t except = kNone);

// Flips edges until opposite angles sum to at most pi (Delaunay), where that folds nothing. Starts from the
// edges around the vertices in `dirty`, or from all edges if it is null.
void flipToDelaunay(EditableMesh& mesh, const std::vector<std::uint32_t>* dirty = nullptr);

// The same from the edges around v, for edges whose four corners the patch owns, while other threads edit
// other patches. stack: workspace.
void flipToDelaunay(EditableMesh& mesh, const Patches& patches, std::uint32_t patch, std::uint32_t v,
                    std::vector<std::uint32_t>& stack);

// The same for all such edges of the patch.
void flipToDelaunay(EditableMesh& mesh, const Patches& patches, std::uint32_t patch);

// Collapses h if topology and facing allow it. Removed triangles are appended to `freed`, or else to the
// mesh's own list.
bool tryCollapse(EditableMesh& mesh, std::uint32_t h, std::vector<std::uint32_t>& freed);
inline bool tryCollapse(EditableMesh& mesh, std::uint32_t h) {
  return tryCollapse(mesh, h, mesh.free);
}

// Largest distance, voxels, from which a vertex is projected back onto the level set, for edges of this
// length. At least half a voxel: that far apart are the trilinear surface, on which meshes begin, and the
// smooth one, at creases and in thin places.
inline float reachFor(float edge) {
  return std::max(edge, 0.5f);
}

// Sets the vertices' scale to the level set's, if it has one.
void takeScale(EditableMesh& mesh, const LevelSet& phi);

// Splits an edge at its midpoint, projected onto the level set. Returns the new vertex.
std::uint32_t splitOnSurface(EditableMesh& mesh, std::uint32_t h, const LevelSet& phi);

// Splits edges longer than `longest` (voxels, at scale 1) until there are none; in a triangle the longest
// first.
void splitLongEdges(EditableMesh& mesh, const LevelSet& phi, float longest);

struct EvenOptions {
  float spacing = 1.0f;  // voxels, at scale 1
  double points = 0.0;   // wanted number of vertices
  int sweeps = 30;       // of repulsion while everything moves
  bool settled = false;  // the points were even in the last frame: only those out of balance move
  bool kept = false;     // and so was the mesh
};

// Evens out the vertices by repulsion between neighbours, restricted to the level set [Turk91]; keeps the
// mesh Delaunay and the number of vertices at options.points. Ends when every vertex is in balance, so that a
// second call changes nothing.
void evenOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options);

}  // namespace fluidtex::texture
