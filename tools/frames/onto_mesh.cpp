#include "tools/frames/onto_mesh.h"

#include "sim/meshes/read_mesh.h"
#include "transport/onto.h"

namespace fluidtex::tools {

texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, const sim::MeshSequence& meshes,
                                  int frame, int symmetry) {
  const sim::MeshSoup soup = sim::readSoup(meshes.fileOf(frame - 1));
  std::vector<texture::Vec3f> positions;
  positions.reserve(soup.points.size());
  for (const sim::Vec3d& x : soup.points) positions.emplace_back(x * meshes.scale + meshes.translate);
  std::vector<texture::Vec3I> triangles;
  for (const auto& polygon : soup.polygons) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      triangles.emplace_back(std::uint32_t(polygon[0]), std::uint32_t(polygon[i - 1]),
                             std::uint32_t(polygon[i]));
  }
  return transport::onto(surface, std::move(positions), std::move(triangles), symmetry);
}

}  // namespace fluidtex::tools
