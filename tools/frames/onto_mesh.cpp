#include "tools/frames/onto_mesh.h"

#include "pipeline/liquid_values.h"
#include "sim/meshes/read_mesh.h"
#include "transport/onto.h"

#include <utility>

namespace fluidtex::tools {

texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, const sim::MeshSequence& meshes,
                                  int frame, int symmetry) {
  const std::filesystem::path file = meshes.fileOf(frame - 1);
  const sim::MeshSoup soup = sim::readSoup(file);
  std::vector<texture::Vec3f> positions = sim::placedPoints(file, soup, meshes.place);
  std::vector<texture::Vec3I> triangles;
  for (const auto& polygon : soup.polygons) {
    for (std::size_t i = 2; i < polygon.size(); ++i)
      triangles.emplace_back(std::uint32_t(polygon[0]), std::uint32_t(polygon[i - 1]),
                             std::uint32_t(polygon[i]));
  }
  return transport::onto(surface, std::move(positions), std::move(triangles), symmetry);
}

texture::TexturedSurface ontoMesh(const texture::TexturedSurface& surface, caches::CachedMesh mesh,
                                  int symmetry) {
  texture::TexturedSurface result =
      transport::onto(surface, std::move(mesh.surface.points), std::move(mesh.surface.triangles), symmetry);
  pipeline::setLiquidValues(mesh.attributes, result);
  return result;
}

}  // namespace fluidtex::tools
