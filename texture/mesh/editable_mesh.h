// A closed triangle mesh that can be changed edge by edge: half-edges in flat arrays.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

// Half-edge h = 3 * triangle + corner runs from origin[h] to origin[next(h)]; twin[h] runs back, in the
// neighbouring triangle. Every operation keeps the mesh closed, oriented and manifold, and keeps its
// topology; none checks geometry.
struct EditableMesh {
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);

  std::vector<Vec3f> position;          // #V
  std::vector<Vec3f> normal;            // #V, unit, or zero where unknown
  std::vector<float> scale;             // #V: edges are so many times as long there; empty: 1 everywhere
  std::vector<std::uint32_t> outgoing;  // #V: one half-edge that starts there; kNone: the vertex is gone
  std::vector<std::uint32_t> origin;    // #H; kNone: the triangle is gone
  std::vector<std::uint32_t> twin;      // #H
  std::vector<std::uint32_t> free;      // triangles that are gone and may be used again

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

  // Whether turning the edge inside its two triangles gives an edge that does not exist yet, and leaves its
  // ends three others.
  bool canFlip(std::uint32_t h) const;
  // After it h starts at the old origin and runs to the old opposite of twin[h]; the new edge is next(h).
  void flip(std::uint32_t h);
  // Both return the new vertex. It gets the scale of one of the old ones beside it.
  std::uint32_t splitEdge(std::uint32_t h, const Vec3f& at, const Vec3f& atNormal);
  std::uint32_t splitTriangle(std::uint32_t triangle, const Vec3f& at, const Vec3f& atNormal);
  // The link condition: the ends have no common neighbours but the two opposite corners, and the mesh there
  // is no tetrahedron.
  bool canCollapse(std::uint32_t h) const;
  // Removes the origin of h; its triangles are handed to the target. The two that vanish are added to
  // `freed`.
  void collapse(std::uint32_t h, std::vector<std::uint32_t>& freed);
  void collapse(std::uint32_t h) { collapse(h, free); }

  // The vertices of one or more whole components, and their triangles.
  void removeComponent(const std::vector<std::uint32_t>& vertices);
  void append(const EditableMesh& part);

  // Drops what is gone. Vertices from number `firstNew` on are moved next to their neighbours, the others
  // keep their order; triangles follow their vertices: what is near on the surface is near in memory.
  void compact(std::size_t firstNew);

 private:
  std::uint32_t newTriangle();
  std::uint32_t newVertex(const Vec3f& at, const Vec3f& atNormal, std::uint32_t beside);
  void link(std::uint32_t a, std::uint32_t b) {
    twin[a] = b;
    twin[b] = a;
  }
};

// The triangles must be closed, oriented and manifold.
EditableMesh makeEditableMesh(std::vector<Vec3f> positions, const std::vector<Vec3I>& triangles);

std::vector<Vec3I> trianglesOf(const EditableMesh& mesh);  // of a compact mesh

// Whether every edge has exactly two triangles, seen in opposite directions, every vertex one ring around it,
// and no two edges share both ends. O(#V + #T); for assertions and tests.
bool isClosedManifold(std::size_t vertices, const std::vector<Vec3I>& triangles);

// For each vertex the smallest number of a vertex connected with it.
std::vector<std::uint32_t> components(std::size_t vertices, const std::vector<Vec3I>& triangles);

}  // namespace fluidtex::texture
