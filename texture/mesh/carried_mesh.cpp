#include "texture/mesh/carried_mesh.h"

#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"
#include "texture/mesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace fluidtex::texture {
namespace {

// For each component of the mesh the component of the iso-surface that it lies on, found by the iso-surface's
// triangles in the cells around its first vertex; kNone without any.
std::vector<std::uint32_t> partsUnder(const EditableMesh& mesh, const Components& meshParts,
                                      const IsoSurface& surface, const Components& parts) {
  const std::size_t count = meshParts.parts.size();
  if (count == 1 && parts.parts.size() == 1) return {0};
  struct Nearest {
    float distance = 1e30f;
    std::uint32_t triangle = kNone;
  };
  std::vector<Nearest> nearest(count);
  std::size_t capacity = 64;
  while (capacity < 64 * count) capacity *= 2;
  std::vector<std::uint8_t> marked(capacity, 0);  // cells beside a first vertex, and some more
  std::unordered_multimap<std::size_t, std::uint32_t> wanted;
  for (std::uint32_t p = 0; p < count; ++p) {
    const Cell c = cellAt(mesh.position[meshParts.parts[p].first], 1.0);
    for (int n = 0; n < 27; ++n) {
      const std::size_t hash = hashOfPlace(c[0] + n % 3 - 1, c[1] + n / 3 % 3 - 1, c[2] + n / 9 - 1);
      marked[hash & (capacity - 1)] = 1;
      wanted.emplace(hash, p);
    }
  }
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const openvdb::Coord& cell = surface.cells[t];
    const std::size_t hash = hashOfPlace(cell.x(), cell.y(), cell.z());
    if (!marked[hash & (capacity - 1)]) continue;
    const Vec3f centre =
        (surface.positions[surface.triangles[t][0]] + surface.positions[surface.triangles[t][1]] +
         surface.positions[surface.triangles[t][2]]) /
        3.0f;
    const Vec3f normal = (surface.positions[surface.triangles[t][1]] - centre)
                             .cross(surface.positions[surface.triangles[t][2]] - centre);
    const auto [begin, end] = wanted.equal_range(hash);
    for (auto it = begin; it != end; ++it) {
      const std::uint32_t v = meshParts.parts[it->second].first;
      const float distance = (mesh.position[v] - centre).lengthSqr();
      Nearest& best = nearest[it->second];
      if (distance < best.distance && normal.dot(mesh.normal[v]) > 0.0f) best = {distance, t};
    }
  }
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (std::uint32_t p = 0; p < parts.parts.size(); ++p) number[parts.parts[p].first] = p;
  std::vector<std::uint32_t> under(count, kNone);
  for (std::size_t p = 0; p < count; ++p) {
    if (nearest[p].triangle != kNone)
      under[p] = number.at(parts.component[surface.triangles[nearest[p].triangle][0]]);
  }
  return under;
}

// Whether the components of mesh and iso-surface correspond one to one, with equal characteristic and about
// equal area. A mesh projected without folds then is a copy.
bool sameParts(const EditableMesh& mesh, const Components& meshParts, const IsoSurface& surface,
               const Components& parts) {
  constexpr double kAreaRatio = 1.3;
  constexpr double kSmall = 30.0;  // square voxels: below it areas of coarse meshes say little
  const std::vector<std::uint32_t> under = partsUnder(mesh, meshParts, surface, parts);
  std::vector<std::uint8_t> taken(parts.parts.size(), 0);
  for (std::size_t p = 0; p < under.size(); ++p) {
    if (under[p] == kNone || taken[under[p]]) return false;
    taken[under[p]] = 1;
    const Components::Part &own = meshParts.parts[p], &its = parts.parts[under[p]];
    if (own.characteristic != its.characteristic) return false;
    if (its.area > kSmall && (own.area > kAreaRatio * its.area || its.area > kAreaRatio * own.area))
      return false;
  }
  return true;
}

}  // namespace

Components componentsOf(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  Components result;
  result.component = components(positions.size(), triangles);
  std::vector<std::uint32_t> number(positions.size(), 0);
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (result.component[v] == v) {
      number[v] = std::uint32_t(result.parts.size());
      result.parts.push_back({v, 0, 0.0});
    }
    result.parts[number[result.component[v]]].characteristic += 2;
  }
  for (const Vec3I& t : triangles) {
    Components::Part& part = result.parts[number[result.component[t[0]]]];
    --part.characteristic;  // 2 (V - E + T) = 2 V - T, since 2 E = 3 T
    part.area += areaOf(positions, t);
  }
  for (Components::Part& part : result.parts) part.characteristic /= 2;
  return result;
}

bool sameTopology(const Components& a, const Components& b) {
  const auto characteristics = [](const Components& components) {
    std::vector<long> list;
    for (const Components::Part& part : components.parts) list.push_back(part.characteristic);
    std::sort(list.begin(), list.end());
    return list;
  };
  return characteristics(a) == characteristics(b);
}

std::optional<EditableMesh> carriedMesh(const LevelSet& phi, const IsoSurface& surface,
                                        const Components& parts, const std::vector<Vec3f>& points,
                                        const std::vector<Vec3I>& triangles, float edge) {
  constexpr float kReach = 1.5f;      // voxels from which a point is brought back
  constexpr float kSnapped = 0.4f;    // voxels from the level set at most, after that
  constexpr float kStill = 1e-3f;     // voxels: a point this near stays exactly where it is
  constexpr double kBadShare = 0.01;  // of the triangles, folded; of the edges, stretched
  constexpr float kStretched = 2.0f;  // mean edge lengths
  std::vector<Vec3f> projected(points.size()), normals(points.size());
  std::vector<std::uint8_t> lost(points.size(), 0);
  forEachIndex(points.size(), [&](std::uint32_t i) {
    lost[i] = 1;
    if (!std::isfinite(points[i].lengthSqr())) return;
    const LevelSet::Projection p = phi.project(points[i], kReach);
    if (!p.known || p.distance > kSnapped) return;
    lost[i] = 0;
    projected[i] = (p.position - points[i]).lengthSqr() < kStill * kStill ? points[i] : p.position;
    normals[i] = p.normal;
  });
  if (std::find(lost.begin(), lost.end(), 1) != lost.end()) return {};

  const Components meshParts = componentsOf(projected, triangles);
  if (!sameTopology(meshParts, parts)) return {};
  EditableMesh mesh = makeEditableMesh(std::move(projected), triangles);
  mesh.normal = std::move(normals);
  takeScale(mesh, phi);
  constexpr std::size_t kGrainOfSums = 4096;
  const double folded = sumOf(
      triangles.size(),
      [&](std::uint32_t t) {
        return facesOutward(mesh, triangles[t][0], triangles[t][1], triangles[t][2]) ? 0.0 : 1.0;
      },
      kGrainOfSums);
  const double stretched = sumOf(
      mesh.halfEdgeCount(),
      [&](std::uint32_t h) {
        const std::uint32_t a = mesh.origin[h], b = mesh.target(h);
        const float most = kStretched * edge * std::max(mesh.scaleAt(a), mesh.scaleAt(b));
        return (mesh.position[a] - mesh.position[b]).lengthSqr() > most * most ? 1.0 : 0.0;
      },
      kGrainOfSums);
  if (folded > kBadShare * double(triangles.size()) || stretched > kBadShare * double(mesh.halfEdgeCount()))
    return {};
  if (!sameParts(mesh, meshParts, surface, parts)) return {};
  return mesh;
}

}  // namespace fluidtex::texture
