// Steps: level set -> iso-surface (topology) -> points -> mesh -> even mesh, level by level.
#include "texture/mesh/prepare.h"

#include "numerics/random.h"
#include "texture/levelset/isosurface.h"
#include "texture/loops/parallel.h"
#include "texture/mesh/carried_mesh.h"
#include "texture/mesh/connect.h"
#include "texture/mesh/mesh_faults.h"
#include "texture/mesh/points.h"
#include "texture/mesh/remesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// One vertex per square of spacing, and at least a tetrahedron's per component. spacing: voxels.
double pointsFor(const LevelSet& phi, const IsoSurface& surface, const Components& components,
                 float spacing) {
  std::vector<double> squares;  // of the scale, by component
  for (const Components::Part& part : components.parts) squares.push_back(phi.scaled() ? 0.0 : part.area);
  if (phi.scaled()) {
    for (const Vec3I& t : surface.triangles) {
      const auto part =
          std::lower_bound(components.parts.begin(), components.parts.end(), components.component[t[0]],
                           [](const Components::Part& p, std::uint32_t first) { return p.first < first; });
      const double scale = phi.scale(surface.positions[t[0]]);
      squares[std::size_t(part - components.parts.begin())] += areaOf(surface.positions, t) / (scale * scale);
    }
  }
  double points = 0.0;
  for (const double room : squares) points += std::max(4.0, room / (double(spacing) * spacing));
  return points;
}

std::vector<Vec3f> toIndex(const std::vector<Vec3f>& positions, const openvdb::math::Transform& transform) {
  std::vector<Vec3f> result(positions.size());
  forEachIndex(positions.size(), [&](std::uint32_t i) {
    result[i] = Vec3f(transform.worldToIndex(openvdb::Vec3d(positions[i])));
  });
  return result;
}

// Whether points, surface and scale are unchanged since the last frame: then points and mesh are kept as they
// are. Points in index space.
bool atRest(const LevelSet& phi, const std::vector<Vec3f>& previous, const std::vector<Vec3f>& now,
            const std::vector<float>& scale) {
  constexpr float kStill = 1e-3f;      // voxels
  constexpr double kOff = 0.05;        // voxels, mean distance of the points from the level set
  constexpr float kSameScale = 0.02f;  // relative
  if (previous.size() != now.size() || (!scale.empty() && scale.size() != now.size())) return false;
  constexpr std::size_t kGrainOfSums = 4096;
  const double moved = sumOf(
      now.size(),
      [&](std::uint32_t i) {
        const float before = scale.empty() ? 1.0f : scale[i];
        const bool same = std::abs(phi.scale(previous[i]) - before) <= kSameScale * before;
        return same && (now[i] - previous[i]).lengthSqr() <= kStill * kStill ? 0.0 : 1.0;
      },
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

SurfaceMesh toWorld(const EditableMesh& mesh, const LevelSet& phi, const openvdb::math::Transform& transform,
                    double spacing) {
  SurfaceMesh result;
  result.spacing = spacing;
  result.positions.resize(mesh.vertexCount());
  result.normals.resize(mesh.vertexCount());
  if (phi.scaled()) result.scale.resize(mesh.vertexCount());
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) {
    result.positions[v] = Vec3f(transform.indexToWorld(openvdb::Vec3d(mesh.position[v])));
    openvdb::Vec3d n = transform.baseMap()->applyIJT(openvdb::Vec3d(normalAt(mesh, v)));
    n.normalize();
    result.normals[v] = Vec3f(n);
    if (phi.scaled()) result.scale[v] = phi.scale(mesh.position[v]);
  });
  result.triangles = trianglesOf(mesh);
  return result;
}

// The last frame's mesh, unchanged.
SurfaceMesh kept(const LevelSet& phi, const Seeds& seeds, const openvdb::math::Transform& transform,
                 double spacing) {
  EditableMesh mesh = makeEditableMesh(toIndex(seeds.previous, transform), seeds.triangles);
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) {
    const Vec3f gradient = phi.sample(mesh.position[v]).gradient;
    const float length = gradient.length();
    if (length > 0.0f) mesh.normal[v] = gradient / length;
  });
  SurfaceMesh result = toWorld(mesh, phi, transform, spacing);
  result.positions = seeds.previous;
  return result;
}

// Shared by all levels of a frame.
struct Ground {
  const openvdb::math::Transform& transform;
  double spacing;  // metres, of the finest level
  LevelSet phi;
  IsoSurface iso;
  Components parts;
};

Ground groundOf(const openvdb::FloatGrid& phi, double spacing, const PointScale& scale) {
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw std::invalid_argument("the spacing must be positive");
  Ground ground{phi.transform(), spacing, LevelSet(phi), {}, {}};
  ground.iso = isoSurface(ground.phi);
  if (ground.iso.triangles.empty()) return ground;
  assert(isClosedManifold(ground.iso.positions.size(), ground.iso.triangles));
  if (scale) layScale(ground.phi, phi.transform(), scale, float(spacing / phi.voxelSize().x()));
  ground.parts = componentsOf(ground.iso.positions, ground.iso.triangles);
  return ground;
}

// Level L has 2^L times the spacing.
EvenOptions evenOptions(const Ground& ground, int level, const SurfaceOptions& options) {
  EvenOptions even;
  even.spacing = float(std::ldexp(ground.spacing, level) / ground.transform.voxelSize().x());
  even.points = pointsFor(ground.phi, ground.iso, ground.parts, even.spacing);
  even.sweeps = options.repulsionSweeps;
  return even;
}

EditableMesh connected(const Ground& ground, const std::vector<Vec3f>& start, int level, float spacing,
                       const SurfaceOptions& options) {
  const PointSet points =
      spreadPoints(ground.phi, ground.iso, start, spacing,
                   randomBits(streamOf(options.seed, Stream::points), std::uint64_t(level)));
  return connectPoints(ground.phi, ground.iso, points, spacing);
}

SurfaceMesh evened(const Ground& ground, EditableMesh mesh, int level, const EvenOptions& even) {
  evenOut(mesh, ground.phi, even);
  SurfaceMesh result = toWorld(mesh, ground.phi, ground.transform, std::ldexp(ground.spacing, level));
  assert(isClosedManifold(result.positions.size(), result.triangles));
  return result;
}

// A level from random points.
SurfaceMesh scatteredLevel(const Ground& ground, int level, const SurfaceOptions& options) {
  const EvenOptions even = evenOptions(ground, level, options);
  return evened(ground, connected(ground, {}, level, even.spacing, options), level, even);
}

// The finest level from the last frame's points, and from its mesh where that still fits.
SurfaceMesh settledLevel(const Ground& ground, const Seeds& seeds, const SurfaceOptions& options) {
  EvenOptions even = evenOptions(ground, 0, options);
  even.settled = true;
  const std::vector<Vec3f> start = toIndex(seeds.positions, ground.transform);
  std::optional<EditableMesh> carried;
  if (!seeds.triangles.empty()) {
    if (atRest(ground.phi, toIndex(seeds.previous, ground.transform), start, seeds.scale) &&
        sameTopology(componentsOf(seeds.previous, seeds.triangles), ground.parts))
      return kept(ground.phi, seeds, ground.transform, ground.spacing);
    carried = carriedMesh(ground.phi, ground.iso, ground.parts, start, seeds.triangles,
                          even.spacing * kEdgePerSpacing);
  }
  if (!carried) return evened(ground, connected(ground, start, 0, even.spacing, options), 0, even);
  even.kept = true;
  flipToDelaunay(*carried);
  return evened(ground, std::move(*carried), 0, even);
}

}  // namespace

double spacingForPoints(const openvdb::FloatGrid& phi, int points, const PointScale& scale) {
  if (points <= 0) throw std::invalid_argument("the number of points must be positive");
  LevelSet field(phi);
  const IsoSurface surface = isoSurface(field);
  double spacing = std::sqrt(squares(field, surface) / points);  // voxels
  if (scale && spacing > 0.0) {  // gradient limiting depends slightly on the spacing
    layScale(field, phi.transform(), scale, float(spacing));
    spacing = std::sqrt(squares(field, surface) / points);
  }
  return phi.voxelSize().x() * spacing;
}

Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const std::vector<Vec3f>& seeds,
                       int levels, const SurfaceOptions& options) {
  return prepareSurface(phi, spacing, Seeds{seeds, {}, {}, {}}, levels, options);
}

Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const Seeds& seeds, int levels,
                       const SurfaceOptions& options, const PointScale& scale) {
  if (levels < 1) throw std::invalid_argument("a surface has at least one level");
  const std::size_t count = seeds.positions.size();
  if ((!seeds.previous.empty() && seeds.previous.size() != count) ||
      (!seeds.scale.empty() && seeds.scale.size() != count))
    throw std::invalid_argument("the seeds' arrays must have one entry per point");
  for (const Vec3I& t : seeds.triangles) {
    if (std::max({t[0], t[1], t[2]}) >= count)
      throw std::invalid_argument("the seeds have a triangle whose vertex does not exist");
  }
  const Ground ground = groundOf(phi, spacing, scale);
  Surface surface;
  if (ground.iso.triangles.empty()) return surface;
  surface.levels.push_back(options.points == Points::seeds && !seeds.positions.empty()
                               ? settledLevel(ground, seeds, options)
                               : scatteredLevel(ground, 0, options));
  for (int level = 1; level < levels; ++level)
    surface.levels.push_back(scatteredLevel(ground, level, options));
  return surface;
}

void addCoarserLevels(const openvdb::FloatGrid& phi, int levels, const SurfaceOptions& options,
                      const PointScale& scale, Surface& surface) {
  if (surface.empty() || int(surface.levels.size()) >= levels) return;
  const Ground ground = groundOf(phi, surface.levels[0].spacing, scale);
  for (int level = int(surface.levels.size()); level < levels; ++level)
    surface.levels.push_back(scatteredLevel(ground, level, options));
}

}  // namespace fluidtex::texture
