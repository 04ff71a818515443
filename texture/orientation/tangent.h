// Tangent-plane calculus on a mesh: polar maps, edge vectors and the connection between neighbouring
// vertices. Complex numbers stand for tangent vectors: real part along the vertex's axis d, imaginary part
// along b = d x n.
#pragma once

#include "texture/surface.h"

#include <complex>
#include <span>

namespace fluidtex::texture {

using Complexf = std::complex<float>;

// The part of x in the plane of normal n, normalised; `otherwise` where nothing is left of it.
inline Vec3f tangentUnit(const Vec3f& x, const Vec3f& n, const Vec3f& otherwise) {
  const Vec3f projected = x - n * n.dot(x);
  const float length = projected.length();
  return length > 1e-6f * x.length() && length > 0.0f ? projected / length : otherwise;
}

// x, tangent at normal `from`, turned into the tangent plane at `to` about their common perpendicular; from .
// to > -1.
inline Vec3f turnedTangent(const Vec3f& x, const Vec3f& from, const Vec3f& to) {
  return x - (from + to) * (to.dot(x) / (1.0f + from.dot(to)));
}

// Of the vectors that x becomes by turns of 360 / symmetry degrees about n, the nearest to `to`; x tangent at
// n.
Vec3f nearestTurn(const Vec3f& x, const Vec3f& n, const Vec3f& to, int symmetry);

// The neighbours of every vertex in order around it (counter-clockwise seen from outside, i.e. the angle in
// (d, b) falls), compressed rows: neighbours of v are neighbor[first[v]] .. neighbor[first[v+1]-1].
struct VertexGraph {
  std::vector<std::uint32_t> first;     // #V + 1
  std::vector<std::uint32_t> neighbor;  // #H, directed edges
  std::span<const std::uint32_t> around(std::uint32_t v) const {
    return {neighbor.data() + first[v], neighbor.data() + first[v + 1]};
  }
};

// Throws std::invalid_argument if the mesh is not closed and manifold.
VertexGraph buildVertexGraph(const SurfaceMesh& mesh);

// For each directed edge v -> u of the graph: where u lies in v's tangent plane, and how v's plane turns into
// u's.
struct Connection {
  // #H: edge vector in v's axes, |edge| = 3D edge length / the mean spacing of its ends; its direction is the
  // edge's angle in the polar map: the surface angle from d times 2 pi / (sum of the face angles around v).
  std::vector<Complexf> edge;
  // #H, unit: a vector x in u's axes is rotation * x in v's axes. The edge seen from its other end is turned
  // by pi.
  std::vector<Complexf> rotation;
};

// `axes`: one unit tangent vector a vertex from which angles are measured (mesh.orientation, or reference
// vectors).
Connection buildConnection(const SurfaceMesh& mesh, const VertexGraph& graph, const std::vector<Vec3f>& axes);

// One tangent unit vector a vertex, chosen consistently: one world axis projected, another where the first is
// nearly normal.
std::vector<Vec3f> referenceVectors(const std::vector<Vec3f>& normals);

}  // namespace fluidtex::texture
