// Half-edge mesh in flat arrays: a closed triangle mesh that is edited edge by edge.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

// Half-edge h = 3 * triangle + corner runs from origin[h] to origin[next(h)]; twin[h] is its opposite in the
// neighbouring triangle. Every operation keeps the mesh closed, oriented and manifold, and its topology. None
// checks geometry.
struct EditableMesh {
  std::vector<Vec3f> position;          // #V
  std::vector<Vec3f> normal;            // #V, unit, or zero where unknown
  std::vector<float> scale;             // #V: factor on edge lengths; empty: 1
  std::vector<std::uint32_t> outgoing;  // #V: one half-edge that starts there; kNone: removed vertex
  std::vector<std::uint32_t> origin;    // #H; kNone: removed triangle
  std::vector<std::uint32_t> twin;      // #H
  std::vector<std::uint32_t> free;      // removed triangles, for reuse

  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  std::uint32_t target(std::uint32_t h) const { return origin[next(h)]; }
  std::uint32_t opposite(std::uint32_t h) const { return origin[previous(h)]; }
  float scaleAt(std::uint32_t v) const { return scale.empty() ? 1.0f : scale[v]; }
  std::size_t vertexCount() const { return position.size(); }
  std::size_t halfEdgeCount() const { return origin.size(); }
  bool alive(std::uint32_t h) const { return origin[h] != kNone; }

  // Calls body(h) for every half-edge that starts at v, in order around it.
  template <class Body>
  void around(std::uint32_t v, const Body& body) const {
    const std::uint32_t start = outgoing[v];
    std::uint32_t h = start;
    do {
      body(h);
      h = twin[previous(h)];
    } while (h != start);
  }
  int valence(std::uint32_t v) const {
    int n = 0;
    around(v, [&n](std::uint32_t) { ++n; });
    return n;
  }
  bool connected(std::uint32_t a, std::uint32_t b) const;

  // Whether the flipped edge does not exist yet, and both ends keep a valence of at least three.
  bool canFlip(std::uint32_t h) const;
  // Afterwards h runs from its origin to the old opposite of twin[h]; the new edge is next(h).
  void flip(std::uint32_t h);
  // Return the new vertex. Its scale is that of an old neighbour.
  std::uint32_t splitEdge(std::uint32_t h, const Vec3f& at, const Vec3f& atNormal);
  std::uint32_t splitTriangle(std::uint32_t triangle, const Vec3f& at, const Vec3f& atNormal);
  // Link condition: the ends have no common neighbours but the two opposite corners, and the component is no
  // tetrahedron.
  bool canCollapse(std::uint32_t h) const;
  // Removes the origin of h and gives its triangles to the target. The two triangles that vanish are appended
  // to `freed`.
  void collapse(std::uint32_t h, std::vector<std::uint32_t>& freed);
  void collapse(std::uint32_t h) { collapse(h, free); }

  // Whole components: all their vertices, with their triangles.
  void removeComponent(const std::vector<std::uint32_t>& vertices);
  void append(const EditableMesh& part);

  // Drops removed entries. Vertices from `firstNew` on are moved next to their neighbours, the others keep
  // their order, and triangles follow their vertices: locality in memory.
  void compact(std::size_t firstNew);

 private:
  std::uint32_t newTriangle();
  std::uint32_t newVertex(const Vec3f& at, const Vec3f& atNormal, std::uint32_t beside);
  void link(std::uint32_t a, std::uint32_t b) {
    twin[a] = b;
    twin[b] = a;
  }
};

// Precondition: the triangles are closed, oriented and manifold.
EditableMesh makeEditableMesh(std::vector<Vec3f> positions, const std::vector<Vec3I>& triangles);

std::vector<Vec3I> trianglesOf(const EditableMesh& mesh);  // precondition: compact

// Whether every edge has exactly two triangles, of opposite orientation, every vertex a single one-ring, and
// no two edges the same ends. O(#V + #T); for assertions and tests.
bool isClosedManifold(std::size_t vertices, const std::vector<Vec3I>& triangles);

// #V: smallest vertex of each vertex's component.
std::vector<std::uint32_t> components(std::size_t vertices, const std::vector<Vec3I>& triangles);

}  // namespace fluidtex::texture
