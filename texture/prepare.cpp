// The way a surface is prepared: level set -> iso-surface (topology) -> points -> mesh -> even mesh, level by
// level.
#include "texture/prepare.h"

#include "texture/connect.h"
#include "texture/isosurface.h"
#include "texture/parallel.h"
#include "texture/points.h"
#include "texture/remesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// One vertex per square of spacing, and no component with fewer than a tetrahedron has. `spacing` in voxels.
double pointsFor(const IsoSurface& surface, float spacing) {
  const std::vector<std::uint32_t> component = components(surface.positions.size(), surface.triangles);
  std::vector<double> areas(surface.positions.size(), 0.0);
  for (const Vec3I& t : surface.triangles) {
    const openvdb::Vec3d a(surface.positions[t[0]]), b(surface.positions[t[1]]), c(surface.positions[t[2]]);
    areas[component[t[0]]] += 0.5 * (b - a).cross(c - a).length();
  }
  double points = 0.0;
  for (std::uint32_t v = 0; v < areas.size(); ++v) {
    if (component[v] == v) points += std::max(4.0, areas[v] / (double(spacing) * spacing));
  }
  return points;
}

// The triangles' own normal around a vertex, for where the level set has no gradient.
Vec3f normalOfTriangles(const EditableMesh& mesh, std::uint32_t v) {
  openvdb::Vec3d sum(0.0);
  mesh.around(v, [&](std::uint32_t h) {
    const openvdb::Vec3d a(mesh.position[v]), b(mesh.position[mesh.target(h)]),
        c(mesh.position[mesh.opposite(h)]);
    sum += (b - a).cross(c - a);
  });
  return sum.normalize() ? Vec3f(sum) : Vec3f(0.0f, 0.0f, 1.0f);
}

SurfaceMesh toWorld(const EditableMesh& mesh, const openvdb::math::Transform& transform, double spacing) {
  SurfaceMesh result;
  result.spacing = spacing;
  result.positions.resize(mesh.vertexCount());
  result.normals.resize(mesh.vertexCount());
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) {
    result.positions[v] = Vec3f(transform.indexToWorld(openvdb::Vec3d(mesh.position[v])));
    const bool known = mesh.normal[v].lengthSqr() > 0.5f;
    const Vec3f normal = known ? mesh.normal[v] : normalOfTriangles(mesh, v);
    openvdb::Vec3d n = transform.baseMap()->applyIJT(openvdb::Vec3d(normal));
    n.normalize();
    result.normals[v] = Vec3f(n);
  });
  result.triangles = trianglesOf(mesh);
  return result;
}

}  // namespace

double spacingForPoints(const openvdb::FloatGrid& phi, int points) {
  if (points <= 0) throw std::invalid_argument("the number of points must be positive");
  const LevelSet field(phi);
  const IsoSurface surface = isoSurface(field);
  return phi.voxelSize().x() * std::sqrt(area(surface.positions, surface.triangles) / points);
}

Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const std::vector<Vec3f>& seeds,
                       int levels, const SurfaceOptions& options) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw std::invalid_argument("the spacing must be positive");
  const LevelSet field(phi);
  const IsoSurface iso = isoSurface(field);
  Surface surface;
  if (iso.triangles.empty()) return surface;
  assert(isClosedManifold(iso.positions.size(), iso.triangles));

  const bool settled = options.points == Points::seeds && !seeds.empty();
  std::vector<Vec3f> start;
  if (settled) {
    start.resize(seeds.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      start[i] = Vec3f(phi.transform().worldToIndex(openvdb::Vec3d(seeds[i])));
    }
  }
  for (int level = 0; level < std::max(levels, 1); ++level) {
    const double levelSpacing = std::ldexp(spacing, level);
    EvenOptions even;
    even.spacing = float(levelSpacing / phi.voxelSize().x());
    even.points = pointsFor(iso, even.spacing);
    even.sweeps = options.repulsionSweeps;
    even.settled = settled && level == 0;
    const PointSet points = spreadPoints(field, iso, level == 0 ? start : std::vector<Vec3f>{}, even.spacing,
                                         options.seed + std::uint64_t(level));
    EditableMesh mesh = connectPoints(field, iso, points, even.spacing);
    evenOut(mesh, field, even);
    surface.levels.push_back(toWorld(mesh, phi.transform(), levelSpacing));
    assert(isClosedManifold(surface.levels.back().positions.size(), surface.levels.back().triangles));
  }
  return surface;
}

}  // namespace fluidtex::texture
