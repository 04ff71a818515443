#include "texture/complex.h"
#include "texture/orient.h"
#include "texture/parallel.h"
#include "texture/tangent_field.h"

#include <cmath>
#include <numbers>

namespace fluidtex::texture {

std::vector<Singularity> singularities(const SurfaceMesh& mesh, int symmetry) {
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, mesh.orientation);
  std::vector<int> turns(mesh.triangles.size());
  forEachIndex(mesh.triangles.size(), [&](std::uint32_t t) {
    // Against the field as axes, each edge's rotation is the turn of the field along it; what is left of
    // their sum once the curvature of the triangle is taken off is a number of full turns.
    Complexf around(1.0f, 0.0f);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][i], to = mesh.triangles[t][(i + 1) % 3];
      // Read from the edge's end with the smaller index, so that both its triangles see the same half turn.
      const std::uint32_t low = std::min(from, to), high = std::max(from, to);
      std::uint32_t h = graph.first[low];
      while (graph.neighbor[h] != high) ++h;
      const Complexf& rotation = connection.rotation[h];
      const double turn = std::arg(power(rotation, symmetry));
      sum += low == to ? turn : -turn;
      around = product(around, low == to ? rotation : std::conj(rotation));
    }
    turns[t] = int(std::lround((sum - symmetry * double(std::arg(around))) / (2.0 * std::numbers::pi)));
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
