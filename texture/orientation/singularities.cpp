#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"
#include "texture/orientation/orient.h"
#include "texture/orientation/tangent_field.h"

#include <cmath>
#include <numbers>

namespace fluidtex::texture {

std::vector<Singularity> singularities(const SurfaceMesh& mesh, int symmetry) {
  const VertexGraph graph = buildVertexGraph(mesh);
  return singularities(mesh, graph, buildConnection(mesh, graph, mesh.orientation), symmetry);
}

std::vector<Singularity> singularities(const SurfaceMesh& mesh, const VertexGraph& graph,
                                       const Connection& connection, int symmetry) {
  const auto edgeTo = [&](std::uint32_t from, std::uint32_t to) {
    std::uint32_t h = graph.first[from];
    while (graph.neighbor[h] != to) ++h;
    return h;
  };
  constexpr double kRounding = 1e-4;  // a triangle without area has an angle of 0
  std::vector<int> turns(mesh.triangles.size());
  forEachIndex(mesh.triangles.size(), [&](std::uint32_t t) {
    // With the field as axes, the rotation of an edge is the turn of the field along it. The sum around a
    // triangle less the triangle's curvature is a whole number of turns. The curvature is the sum of its
    // angles in the polar maps less pi: on a drop of four vertices it is pi per triangle, which the product
    // of the three rotations could not tell from -pi.
    double sum = 0.0, curvature = -std::numbers::pi;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][i], to = mesh.triangles[t][(i + 1) % 3],
                          last = mesh.triangles[t][(i + 2) % 3];
      // Read from the end of smaller index, so that both triangles of the edge see the same half turn.
      const std::uint32_t low = std::min(from, to), high = std::max(from, to);
      const double turn = std::arg(power(connection.rotation[edgeTo(low, high)], symmetry));
      sum += low == to ? turn : -turn;
      // From the edge that comes first counter-clockwise; in [0, 2 pi).
      const double angle =
          std::arg(conjugateProduct(connection.edge[edgeTo(from, last)], connection.edge[edgeTo(from, to)]));
      curvature += angle < -kRounding ? angle + 2.0 * std::numbers::pi : angle;
    }
    turns[t] = int(std::lround((sum + symmetry * curvature) / (2.0 * std::numbers::pi)));
  });
  std::vector<Singularity> found;
  for (std::size_t t = 0; t < turns.size(); ++t) {
    if (turns[t] == 0) continue;
    const Vec3I& corner = mesh.triangles[t];
    found.push_back(
        {(mesh.positions[corner[0]] + mesh.positions[corner[1]] + mesh.positions[corner[2]]) / 3.0f,
         turns[t]});
  }
  return found;
}

}  // namespace fluidtex::texture
