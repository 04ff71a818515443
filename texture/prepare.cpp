// The way a surface is prepared: level set -> iso-surface (topology) -> points -> mesh -> even mesh, level by
// level.
#include "texture/prepare.h"

#include "texture/carried_mesh.h"
#include "texture/connect.h"
#include "texture/isosurface.h"
#include "texture/parallel.h"
#include "texture/points.h"
#include "texture/remesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// One vertex per square of spacing, and no component with fewer than a tetrahedron has. `spacing` in voxels.
double pointsFor(const Components& components, float spacing) {
  double points = 0.0;
  for (const Components::Part& part : components.parts)
    points += std::max(4.0, part.area / (double(spacing) * spacing));
  return points;
}

std::vector<Vec3f> toIndex(const std::vector<Vec3f>& positions, const openvdb::math::Transform& transform) {
  std::vector<Vec3f> result(positions.size());
  forEachIndex(positions.size(), [&](std::uint32_t i) {
    result[i] = Vec3f(transform.worldToIndex(openvdb::Vec3d(positions[i])));
  });
  return result;
}

// Whether neither the points nor the surface under them have moved since the last frame: then everything
// stays as it is. Points in index space.
bool atRest(const LevelSet& phi, const std::vector<Vec3f>& previous, const std::vector<Vec3f>& now) {
  constexpr float kStill = 1e-3f;  // voxels
  constexpr double kOff = 0.05;    // voxels, mean distance of the points from the level set
  if (previous.size() != now.size()) return false;
  constexpr std::size_t kGrainOfSums = 4096;
  const double moved = sumOf(
      now.size(),
      [&](std::uint32_t i) { return (now[i] - previous[i]).lengthSqr() <= kStill * kStill ? 0.0 : 1.0; },
      kGrainOfSums);
  if (moved > 0.0) return false;
  const double off = sumOf(
      now.size(),
      [&](std::uint32_t i) {
        const LevelSet::Sample s = phi.sample(previous[i]);
        return s.known ? std::abs(s.value) : 1.0f;
      },
      kGrainOfSums);
  return off <= kOff * double(now.size());
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

// The last frame's mesh as it was, on a surface that has not moved.
SurfaceMesh kept(const LevelSet& phi, const Seeds& seeds, const openvdb::math::Transform& transform,
                 double spacing) {
  EditableMesh mesh = makeEditableMesh(toIndex(seeds.previous, transform), seeds.triangles);
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) {
    const Vec3f gradient = phi.sample(mesh.position[v]).gradient;
    const float length = gradient.length();
    if (length > 0.0f) mesh.normal[v] = gradient / length;
  });
  SurfaceMesh result = toWorld(mesh, transform, spacing);
  result.positions = seeds.previous;
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
  return prepareSurface(phi, spacing, Seeds{seeds, {}, {}}, levels, options);
}

Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const Seeds& seeds, int levels,
                       const SurfaceOptions& options) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw std::invalid_argument("the spacing must be positive");
  const LevelSet field(phi);
  const IsoSurface iso = isoSurface(field);
  Surface surface;
  if (iso.triangles.empty()) return surface;
  assert(isClosedManifold(iso.positions.size(), iso.triangles));

  const Components parts = componentsOf(iso.positions, iso.triangles);
  const bool settled = options.points == Points::seeds && !seeds.positions.empty();
  for (int level = 0; level < std::max(levels, 1); ++level) {
    const double levelSpacing = std::ldexp(spacing, level);
    EvenOptions even;
    even.spacing = float(levelSpacing / phi.voxelSize().x());
    even.points = pointsFor(parts, even.spacing);
    even.sweeps = options.repulsionSweeps;
    even.settled = settled && level == 0;
    std::vector<Vec3f> start;
    if (even.settled) start = toIndex(seeds.positions, phi.transform());
    std::optional<EditableMesh> carried;
    if (even.settled && !seeds.triangles.empty()) {
      if (atRest(field, toIndex(seeds.previous, phi.transform()), start) &&
          sameTopology(componentsOf(seeds.previous, seeds.triangles), parts)) {
        surface.levels.push_back(kept(field, seeds, phi.transform(), levelSpacing));
        continue;
      }
      carried = carriedMesh(field, iso, parts, start, seeds.triangles, even.spacing * kEdgePerSpacing);
    }
    EditableMesh mesh;
    if (carried) {
      mesh = std::move(*carried);
      flipToDelaunay(mesh);
    } else {
      const PointSet points =
          spreadPoints(field, iso, start, even.spacing, options.seed + std::uint64_t(level));
      mesh = connectPoints(field, iso, points, even.spacing);
    }
    evenOut(mesh, field, even);
    surface.levels.push_back(toWorld(mesh, phi.transform(), levelSpacing));
    assert(isClosedManifold(surface.levels.back().positions.size(), surface.levels.back().triangles));
  }
  return surface;
}

}  // namespace fluidtex::texture
