#include "texture/orientation/curvature.h"

#include "texture/loops/parallel.h"
#include "texture/mesh/vertex_graph.h"

namespace fluidtex::texture {
namespace {

// Sweeps of averaging, so that the grid behind the normals is not seen.
constexpr int kSweeps = 4;

}  // namespace

std::vector<float> meanCurvature(const SurfaceMesh& mesh) {
  const VertexGraph graph = buildVertexGraph(mesh);
  const std::vector<Vec3f>&x = mesh.positions, &n = mesh.normals;
  std::vector<float> curvature(x.size(), 0.0f), next(x.size()), area(x.size(), 0.0f);
  // Half the divergence of the normal, which is linear over each triangle; at a vertex the area-weighted mean
  // over its triangles.
  for (const Vec3I& t : mesh.triangles) {
    const Vec3f across = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    const float twice = across.length();
    if (!(twice > 0.0f)) continue;
    float divergence = 0.0f;  // times twice the area
    for (int k = 0; k < 3; ++k) {
      const Vec3f opposite = x[t[(k + 2) % 3]] - x[t[(k + 1) % 3]];
      divergence += n[t[k]].dot(across.cross(opposite)) / twice;
    }
    for (int k = 0; k < 3; ++k) curvature[t[k]] += 0.5f * divergence, area[t[k]] += twice;
  }
  for (std::size_t v = 0; v < x.size(); ++v) curvature[v] = area[v] > 0.0f ? curvature[v] / area[v] : 0.0f;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    forEachIndex(x.size(), [&](std::uint32_t v) {
      float sum = curvature[v];
      for (const std::uint32_t u : graph.around(v)) sum += curvature[u];
      next[v] = sum / float(graph.around(v).size() + 1);
    });
    curvature.swap(next);
  }
  return curvature;
}

}  // namespace fluidtex::texture
