#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/cgal_mesh.h"
#include "tools/benchmarks/peers/closest_points.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

namespace fluidtex::benchmarks {

ClosestRun cgalClosest(const std::vector<texture::Vec3f>& positions,
                       const std::vector<texture::Vec3I>& triangles,
                       const std::vector<texture::Vec3f>& queries) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
  Mesh mesh = cgalMesh<Kernel::Point_3>(positions, triangles);

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
