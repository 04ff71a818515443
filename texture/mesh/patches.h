// A mesh's vertices shared out among cubes of space, so that each cube's may be worked on by a thread of its
// own.
#pragma once

#include "texture/mesh/editable_mesh.h"

#include <tbb/parallel_for.h>

namespace fluidtex::texture {

// What may be done in one patch while others work in theirs: a vertex may be moved or collapsed whose whole
// ring is the patch's own, and an edge flipped all four of whose corners are. Then nothing is read that
// another patch writes: a triangle is changed by the patch that all of its corners belong to, the twin of a
// half-edge by that of both its ends, and walking around a vertex reads no twin of an edge that lies opposite
// to it.
struct Patches {
  std::vector<std::uint32_t> of;      // #V, or number of places
  std::vector<std::uint32_t> first;   // #P + 1, into vertex
  std::vector<std::uint32_t> vertex;  // patch by patch, in order of their number

  std::size_t count() const { return first.size() - 1; }
  bool owns(std::uint32_t patch, std::uint32_t v) const { return of[v] == patch; }
  // Whether v and all vertices around it are the patch's.
  bool ownsRing(const EditableMesh& mesh, std::uint32_t patch, std::uint32_t v) const {
    if (of[v] != patch) return false;
    bool all = true;
    mesh.around(v, [&](std::uint32_t h) { all = all && of[mesh.target(h)] == patch; });
    return all;
  }
};

// Cubes of `side` with a corner at `corner`, in the units of the places.
Patches patchesOf(const std::vector<Vec3f>& places, float side, const Vec3f& corner = Vec3f(0.0f));
// Vertices that are gone belong to none: `of` is kNone.
Patches patchesOf(const EditableMesh& mesh, float side, const Vec3f& corner = Vec3f(0.0f));

// Calls body(patch) for every patch, at once.
template <typename Body>
void forEachPatch(const Patches& patches, const Body& body) {
  tbb::parallel_for(std::size_t(0), patches.count(), [&](std::size_t patch) { body(std::uint32_t(patch)); });
}

}  // namespace fluidtex::texture
