// N-RoSy fields on a mesh: direction fields with the symmetry of a rotation by 360 / N degrees; N = 1
// vectors, 2 lines, 4 crosses. A direction at angle a in its vertex's axes is the complex number e^(i N a),
// so that its N equal directions are one value and can be averaged (Knoeppel, Crane, Pinkall, Schroeder:
// Globally Optimal Direction Fields, 2013).
#pragma once

#include "texture/mesh/vertex_graph.h"
#include "texture/orientation/tangent.h"

namespace fluidtex::texture {

// z^n, n >= 1.
Complexf power(const Complexf& z, int n);

// Graph, connection and edge weights that define the smoothness of a field.
struct FieldGraph {
  const VertexGraph& graph;
  std::vector<Complexf> rotation;  // #H, unit: a value x at u is rotation * x seen from v
  std::vector<float> stiffness;    // #V, > 0; empty: 1. An edge has the mean of its ends
};

FieldGraph fieldGraph(const VertexGraph& graph, const Connection& connection, int symmetry,
                      std::vector<float> stiffness = {});

// Solves (L + diag(hold)) values = right, with L the connection Laplacian, (L x)(v) = sum over edges v -> u
// of stiffness (x(v) - rotation x(u)): the smoothest field under a soft constraint to right / hold. Conjugate
// gradients from the given values, until a Jacobi sweep would change them by less than `tolerance` of their
// rms, or for `mostSteps` steps. hold: #V, > 0.
void solveField(const FieldGraph& field, const std::vector<float>& hold, const std::vector<Complexf>& right,
                int mostSteps, double tolerance, std::vector<Complexf>& values);

// Mean of the value at v and its neighbours' predictions.
Complexf average(const FieldGraph& field, const std::vector<Complexf>& values, std::uint32_t v);

// Scales every value to length 1; zeros become 1.
void normalise(std::vector<Complexf>& values);

}  // namespace fluidtex::texture
