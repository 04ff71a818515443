// Partition of a mesh's vertices into cubes of space, for parallel edits.
#pragma once

#include "texture/mesh/editable_mesh.h"

#include <tbb/parallel_for.h>

namespace fluidtex::texture {

// Edits allowed in one patch while other threads edit others: moving or collapsing a vertex whose one-ring
// the patch owns, and flipping an edge whose four corners it owns. Then no patch reads what another one
// writes: a triangle is changed by the owner of all its corners, the twin of a half-edge by the owner of both
// its ends, and a walk around a vertex reads no twin of an opposite edge.
struct Patches {
  std::vector<std::uint32_t> of;      // #V, or one per position: the patch
  std::vector<std::uint32_t> first;   // #P + 1, into vertex
  std::vector<std::uint32_t> vertex;  // patch by patch, ascending

  std::size_t count() const { return first.size() - 1; }
  bool owns(std::uint32_t patch, std::uint32_t v) const { return of[v] == patch; }
  // Whether the patch owns v and its one-ring.
  bool ownsRing(const EditableMesh& mesh, std::uint32_t patch, std::uint32_t v) const {
    if (of[v] != patch) return false;
    bool all = true;
    mesh.around(v, [&](std::uint32_t h) { all = all && of[mesh.target(h)] == patch; });
    return all;
  }
};

// Cubes of `side` with a corner at `corner`, in the units of `places`.
Patches patchesOf(const std::vector<Vec3f>& places, float side, const Vec3f& corner = Vec3f(0.0f));
// Removed vertices have the patch kNone.
Patches patchesOf(const EditableMesh& mesh, float side, const Vec3f& corner = Vec3f(0.0f));

// Calls body(patch) for every patch, in parallel.
template <typename Body>
void forEachPatch(const Patches& patches, const Body& body) {
  tbb::parallel_for(std::size_t(0), patches.count(), [&](std::size_t patch) { body(std::uint32_t(patch)); });
}

}  // namespace fluidtex::texture
