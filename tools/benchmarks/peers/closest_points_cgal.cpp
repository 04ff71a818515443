#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/closest_points.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>

namespace fluidtex::benchmarks {

ClosestRun cgalClosest(const std::vector<texture::Vec3f>& positions,
                       const std::vector<texture::Vec3I>& triangles,
                       const std::vector<texture::Vec3f>& queries) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertex;
  vertex.reserve(positions.size());
  for (const texture::Vec3f& p : positions)
    vertex.push_back(mesh.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  for (const texture::Vec3I& t : triangles) mesh.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]);

  ClosestRun run;
  double from = processorSeconds();
  Tree tree(faces(mesh).begin(), faces(mesh).end(), mesh);
  tree.accelerate_distance_queries();
  tree.build();
  run.build = processorSeconds() - from;
  from = processorSeconds();
  for (const texture::Vec3f& q : queries)
    run.sum += std::sqrt(tree.squared_distance(Kernel::Point_3(q.x(), q.y(), q.z())));
  run.query = processorSeconds() - from;
  return run;
}

}  // namespace fluidtex::benchmarks
