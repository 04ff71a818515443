// Tangent-plane calculus on a mesh: polar maps, edge vectors and the connection between neighbouring
// vertices. Complex numbers are tangent vectors: real part along the vertex's axis d, imaginary part along b
// = d x n.
#pragma once

#include "texture/mesh/vertex_graph.h"
#include "texture/surface.h"

#include <complex>

namespace fluidtex::texture {

using Complexf = std::complex<float>;

// Projection of x onto the tangent plane of n, normalised; `otherwise` where it vanishes.
inline Vec3f tangentUnit(const Vec3f& x, const Vec3f& n, const Vec3f& otherwise) {
  const Vec3f projected = x - n * n.dot(x);
  const float length = projected.length();
  return length > 1e-6f * x.length() && length > 0.0f ? projected / length : otherwise;
}

// Parallel transport of x, tangent at normal `from`, to the tangent plane at `to`: rotation about their
// common perpendicular. Precondition: from . to > -1.
inline Vec3f turnedTangent(const Vec3f& x, const Vec3f& from, const Vec3f& to) {
  return x - (from + to) * (to.dot(x) / (1.0f + from.dot(to)));
}

// Of the rotations of x by multiples of 360 / symmetry degrees about n, the nearest to `to`. x is tangent at
// n.
Vec3f nearestTurn(const Vec3f& x, const Vec3f& n, const Vec3f& to, int symmetry);

// For each half-edge v -> u of the graph: the position of u in v's tangent plane, and the rotation between
// their planes.
struct Connection {
  // #H: edge vector in v's axes. |edge| = length in space / mean spacing of its ends. Its direction is the
  // edge's angle in the polar map: the surface angle from d times 2 pi / (sum of the face angles around v).
  std::vector<Complexf> edge;
  // #H, unit: a vector x in u's axes is rotation * x in v's axes. The edge seen from its other end is rotated
  // by pi.
  std::vector<Complexf> rotation;
};

// axes, #V: unit tangent vectors from which angles are measured (mesh.orientation, or reference vectors).
Connection buildConnection(const SurfaceMesh& mesh, const VertexGraph& graph, const std::vector<Vec3f>& axes);

// #V, unit tangent vectors chosen consistently: the projection of one world axis, of another where the first
// is nearly normal.
std::vector<Vec3f> referenceVectors(const std::vector<Vec3f>& normals);

}  // namespace fluidtex::texture
