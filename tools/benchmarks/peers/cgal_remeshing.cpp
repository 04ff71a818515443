#include "tools/benchmarks/peers/cgal_remeshing.h"
#include "texture/mesh/remesh.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/cgal_mesh.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

namespace fluidtex::benchmarks {

Remeshed cgalIsotropicRemeshing(const std::vector<texture::Vec3f>& positions,
                                const std::vector<texture::Vec3I>& triangles, int iterations) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  namespace pmp = CGAL::Polygon_mesh_processing;
  Mesh mesh = cgalMesh<Kernel::Point_3>(positions, triangles);

  Remeshed result;
  const double start = wallSeconds();
  pmp::isotropic_remeshing(faces(mesh), double(texture::kEdgePerSpacing), mesh,
                           pmp::parameters::number_of_iterations(static_cast<unsigned>(iterations)));
  result.seconds = wallSeconds() - start;

  std::vector<std::uint32_t> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    number[v] = std::uint32_t(result.positions.size());
    const Kernel::Point_3& p = mesh.point(v);
    result.positions.emplace_back(float(p.x()), float(p.y()), float(p.z()));
  }
  for (const Mesh::Face_index f : mesh.faces()) {
    texture::Vec3I corners;
    int corner = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
      corners[corner++] = number[v];
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace fluidtex::benchmarks
