// Fields of directions on a mesh that look the same when turned by a full turn / N: N = 1 arrows, 2 lines, 4
// crosses. A direction at angle a in its vertex's axes is the complex number e^(i N a), so that all N of its
// arrows are one value and can be averaged (Knoeppel, Crane, Pinkall, Schroeder: Globally Optimal Direction
// Fields, 2013).
#pragma once

#include "texture/orientation/tangent.h"

namespace fluidtex::texture {

// z to the power n, n >= 1.
Complexf power(const Complexf& z, int n);

// What a field is smooth with respect to: neighbours, how a value turns between them, how much a turn costs.
struct FieldGraph {
  const VertexGraph& graph;
  std::vector<Complexf> rotation;  // #H, unit: a value x at u is rotation * x seen from v
  std::vector<float> stiffness;    // #V, > 0; empty: all 1. That of an edge is the mean of its ends'
};

FieldGraph fieldGraph(const VertexGraph& graph, const Connection& connection, int symmetry,
                      std::vector<float> stiffness = {});

// (L + diag(hold)) values = right, where (L x)(v) = sum over edges v -> u of stiffness (x(v) - rotation
// x(u)), the connection's Laplacian: the smoothest field that is held to right / hold. By conjugate gradients
// from the values given, until a Jacobi sweep would change the values by less than `tolerance` of their size
// (root mean square) or after `mostSteps`. hold: #V, > 0.
void solveField(const FieldGraph& field, const std::vector<float>& hold, const std::vector<Complexf>& right,
                int mostSteps, double tolerance, std::vector<Complexf>& values);

// The mean of the value at v and of what its neighbours predict for it.
Complexf average(const FieldGraph& field, const std::vector<Complexf>& values, std::uint32_t v);

// Every value brought to length 1; 1 where there is none.
void normalise(std::vector<Complexf>& values);

}  // namespace fluidtex::texture
