#include "caches/liquid/read_frame.h"

#include "caches/formats/flip_fluids.h"
#include "caches/formats/read_fields.h"
#include "caches/formats/read_geometry.h"
#include "caches/liquid/cells_crossed.h"
#include "caches/liquid/further_fields.h"
#include "caches/liquid/level_set.h"
#include "caches/liquid/mantaflow_frame.h"
#include "caches/liquid/particle_velocity.h"
#include "caches/liquid/particles.h"
#include "caches/liquid/placement.h"
#include "caches/liquid/surface_velocity.h"
#include "caches/liquid/velocity_grids.h"

#include <fmt/core.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <system_error>
#include <utility>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

using openvdb::Mat3d;
using openvdb::Mat4d;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Level of densities where nothing is said: this share of the largest.
constexpr float kIsoShare = 0.5f;

bool isMantaflow(const Cache& cache) {
  return cache.layout.program == Program::mantaflow;
}

double largestOf(const openvdb::FloatGrid& grid) {
  float largest = 0.0f;
  for (auto value = grid.cbeginValueOn(); value; ++value) largest = std::max(largest, *value);
  return double(largest);
}

// What a frame's files hold, in the world's place, before it becomes grids.
struct Raw {
  SurfaceTriangles surface;
  Geometry geometry;  // of meshes and particles, as in the file
};

double radiusOf(const Cache& cache, const std::vector<Vec3f>& points) {
  return cache.options.radius > 0.0 ? cache.options.radius : 0.5 * particleSpacing(points);
}

SurfaceTriangles surfaceInGrid(const Cache& cache, const fs::path& file) {
  const openvdb::FloatGrid::Ptr grid = readScalars(file, cache.layout.surfaceName);
  if (cache.layout.surfaceKind != SurfaceKind::fog) return surfaceOfGrid(*grid, cache.options.iso);
  const double iso = cache.options.iso > 0.0 ? cache.options.iso : kIsoShare * largestOf(*grid);
  return iso > 0.0 ? surfaceOfGrid(*grid, iso) : SurfaceTriangles{};
}

Raw readRaw(const Cache& cache, int number) {
  const fs::path& file = cache.layout.surface.at(number);
  Raw raw;
  if (isEmptyFile(file)) return raw;
  Mat4d world = worldFromFile(cache.options);
  switch (cache.layout.surfaceKind) {
    case SurfaceKind::mesh:
      raw.geometry = readGeometry(file);
      raw.surface = {raw.geometry.points, raw.geometry.triangles};
      if (isMantaflow(cache)) world = mantaflowPlace(cache, number).worldFromMesh * world;
      break;
    case SurfaceKind::particles:
      raw.geometry = readGeometry(file);
      raw.surface = surfaceOfParticles(raw.geometry.points, 2.0 * radiusOf(cache, raw.geometry.points));
      break;
    case SurfaceKind::mantaflow: {
      const MantaflowPlace place = mantaflowPlace(cache, number);
      raw.surface = surfaceOfGrid(*mantaflowDistance(file, place.resolution), 0.0);
      world = place.worldFromIndex * world;
      break;
    }
    case SurfaceKind::levelSet:
    case SurfaceKind::fog:
      raw.surface = surfaceInGrid(cache, file);
      break;
  }
  place(world, raw.surface.points);
  dropPieces(cache.options.leastPiece, raw.surface);
  return raw;
}

void checkSize(const Cache& cache, int number, const SurfaceTriangles& surface) {
  const double h = cache.voxel;
  const CellsCrossed crossed = cellsCrossed(surface, h);
  if (crossed.fits(h)) return;
  throw LayoutError(
      fmt::format("{}: its surface crosses {:.3g} cells of {:.3g} m, up to {:.3g} m from the origin, which "
                  "is too many or "
                  "too far; look for stray points in it, or give larger cells with files.voxel",
                  cache.layout.surface.at(number).string(), crossed.cells, h, crossed.farthest));
}

std::vector<float> inWorld(std::vector<float> vectors, const Mat3d& velocityFromFile) {
  for (std::size_t n = 0; n + 2 < vectors.size(); n += 3) {
    const Vec3d v = velocityFromFile.transform(Vec3d(vectors[n], vectors[n + 1], vectors[n + 2]));
    for (int axis = 0; axis < 3; ++axis) vectors[n + std::size_t(axis)] = float(v[axis]);
  }
  return vectors;
}

void atPoints(const Cache& cache, ClosestTriangles& closest, const std::vector<float>& vectors,
              LiquidFrame& frame) {
  frame.velocity =
      velocityOffSurface(closest, vectors, reachInCells(vectors, 1.0 / cache.frameRate, cache.voxel));
}

void velocityOfAttribute(const Cache& cache, int number, const Raw& raw, ClosestTriangles& closest,
                         LiquidFrame& frame) {
  const std::string& name = cache.layout.velocityNames.front();
  const auto attribute = raw.geometry.attributes.find(name);
  if (attribute == raw.geometry.attributes.end() || attribute->second.components != 3)
    throw LayoutError(cache.layout.surface.at(number).string() + ": lacks the attribute " + name +
                      ", which other frames have; write it for all frames");
  const std::vector<float>& values = attribute->second.values;
  if (const auto bad =
          std::find_if_not(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
      bad != values.end())
    throw FormatError(cache.layout.surface.at(number).string() + ": its attribute " + name +
                      " is no number at point " + std::to_string((bad - values.begin()) / 3) +
                      "; write finite velocities");
  if (cache.layout.surfaceKind == SurfaceKind::particles) {
    RawVelocity grids;
    grids.vectors =
        velocityOfParticles(raw.geometry.points, values, 2.0 * radiusOf(cache, raw.geometry.points));
    grids.worldFromFile = worldFromFile(cache.options);
    grids.velocityFromFile = velocityFromFile(cache.options);
    frame.velocity = velocityGrids(grids, *frame.phi, kMostReach * cache.voxel);
    return;
  }
  atPoints(cache, closest, inWorld(values, velocityFromFile(cache.options)), frame);
}

// FLIP Fluids' velocities are in the simulation's unit. Displacements of a frame, where there are some, are
// in the mesh's: the factor between them is that of least squares.
void velocityOfFlipFluids(const Cache& cache, int number, const Raw& raw, ClosestTriangles& closest,
                          LiquidFrame& frame) {
  const fs::path& file = cache.layout.velocity.at(number);
  const std::vector<Vec3f> velocity = readFlipVectors(file);
  if (velocity.size() != raw.geometry.points.size())
    throw LayoutError(file.string() + ": holds " + std::to_string(velocity.size()) + " vectors, the mesh " +
                      std::to_string(raw.geometry.points.size()) + " points; bake both anew");
  double factor = 1.0;
  if (!cache.layout.blur.empty()) {
    const std::vector<Vec3f> blur = readFlipVectors(cache.layout.blur.at(number));
    if (blur.size() != velocity.size())
      throw LayoutError(cache.layout.blur.at(number).string() + ": holds " + std::to_string(blur.size()) +
                        " vectors, the mesh " + std::to_string(velocity.size()) + " points; bake both anew");
    double both = 0.0, squares = 0.0;
    for (std::size_t n = 0; n < velocity.size(); ++n) {
      both += double(blur[n].dot(velocity[n]));
      squares += double(velocity[n].lengthSqr());
    }
    if (both > 0.0 && squares > 0.0) factor = both / squares * cache.frameRate;
  }
  std::vector<float> values;
  values.reserve(3 * velocity.size());
  for (const Vec3f& v : velocity)
    for (int axis = 0; axis < 3; ++axis) values.push_back(float(factor) * v[axis]);
  atPoints(cache, closest, inWorld(std::move(values), velocityFromFile(cache.options)), frame);
}

std::string placeOf(const openvdb::BBoxd& box) {
  return fmt::format("from ({:.3g}, {:.3g}, {:.3g}) to ({:.3g}, {:.3g}, {:.3g}) m", box.min()[0],
                     box.min()[1], box.min()[2], box.max()[0], box.max()[1], box.max()[2]);
}

// Velocities that lie elsewhere are those of another unit, or of other axes.
void checkPlaces(const fs::path& file, const RawVelocity& raw, const SurfaceTriangles& surface,
                 double margin) {
  const openvdb::BBoxd velocities = boundsOf(raw), liquid = boundsOf(surface);
  openvdb::BBoxd near = liquid;
  near.expand(margin);
  if (velocities.empty() || near.hasOverlap(velocities)) return;
  throw LayoutError(file.string() + ": its velocities lie " + placeOf(velocities) + ", and the surface " +
                    placeOf(liquid) + "; write both in one unit, with one axis up");
}

RawVelocity readVelocityGrids(const Cache& cache, int number) {
  const fs::path& file = cache.layout.velocity.at(number);
  RawVelocity raw;
  raw.onFaces = cache.layout.onFaces;
  raw.worldFromFile = worldFromFile(cache.options);
  raw.velocityFromFile = velocityFromFile(cache.options);
  if (cache.layout.velocityNames.size() == 1) {
    raw.vectors = readVectors(file, cache.layout.velocityNames.front());
  } else {
    for (std::size_t axis = 0; axis < 3; ++axis)
      raw.numbers[axis] = readScalars(file, cache.layout.velocityNames[axis]);
  }
  if (isMantaflow(cache)) {
    const MantaflowPlace place = mantaflowPlace(cache, number);
    raw.vectors->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
    closeUpperSides(place.resolution, *raw.vectors);
    raw.worldFromFile = place.worldFromIndex * raw.worldFromFile;
    raw.velocityFromFile = place.metersPerSecond * raw.velocityFromFile;
  }
  return raw;
}

// Grids of velocity while another thread is busy with the surface, since a process of its own reads them.
// What is wrong with them counts only where there is a surface.
class VelocityAhead {
 public:
  void read(const Cache& cache, int number) {
    if (cache.layout.velocityKind != VelocityKind::grids || isEmptyFile(cache.layout.velocity.at(number)))
      return;
    try {
      m_raw = readVelocityGrids(cache, number);
    } catch (...) {
      m_wrong = std::current_exception();
    }
  }

  std::optional<RawVelocity> take() {
    if (m_wrong) std::rethrow_exception(m_wrong);
    return std::move(m_raw);
  }

 private:
  std::optional<RawVelocity> m_raw;
  std::exception_ptr m_wrong;
};

void readVelocity(const Cache& cache, int number, const Raw& raw, VelocityAhead& ahead,
                  ClosestTriangles& closest, LiquidFrame& frame) {
  switch (cache.layout.velocityKind) {
    case VelocityKind::none:
      return;
    case VelocityKind::attribute:
      if (!raw.geometry.points.empty()) velocityOfAttribute(cache, number, raw, closest, frame);
      return;
    case VelocityKind::flipFluids:
      if (!raw.geometry.points.empty()) velocityOfFlipFluids(cache, number, raw, closest, frame);
      return;
    case VelocityKind::grids:
      if (const std::optional<RawVelocity> grids = ahead.take()) {
        checkPlaces(cache.layout.velocity.at(number), *grids, raw.surface, kLeastReach * cache.voxel);
        frame.velocity = velocityGrids(*grids, *frame.phi, kMostReach * cache.voxel);
      }
      return;
  }
}

}  // namespace

SurfaceTriangles readSurface(const Cache& cache, int number) {
  return readRaw(cache, number).surface;
}

CachedMesh readMesh(const Cache& cache, int number) {
  Raw raw = readRaw(cache, number);
  CachedMesh mesh{std::move(raw.surface), {}};
  for (const Field& field : cache.layout.fields) {
    const auto found = raw.geometry.attributes.find(field.name);
    const int components = field.vectors ? 3 : 1;
    if (field.withVelocity || found == raw.geometry.attributes.end() ||
        found->second.components != components)
      continue;
    const std::vector<float>& values = found->second.values;
    const std::vector<std::string> names = scalarNames(field);
    for (std::size_t c = 0; c < names.size(); ++c) {
      std::vector<float>& one = mesh.attributes[names[c]];
      one.reserve(mesh.surface.points.size());
      for (std::size_t n = c; n < values.size(); n += names.size()) one.push_back(values[n]);
    }
  }
  return mesh;
}

LiquidFrame readFrame(const Cache& cache, int number) {
  Raw raw;
  LiquidFrame frame;
  VelocityAhead ahead;
  std::optional<ClosestTriangles> closest;
  const auto readLevelSet = [&] {
    raw = readRaw(cache, number);
    checkSize(cache, number, raw.surface);
    closest.emplace(raw.surface, cache.voxel);
    LevelSet levelSet = levelSetOf(*closest);
    frame.phi = std::move(levelSet.phi);
    frame.isSheet = levelSet.isSheet;
  };
  tbb::parallel_invoke(readLevelSet, [&] { ahead.read(cache, number); });
  if (!raw.surface.triangles.empty()) {
    readVelocity(cache, number, raw, ahead, *closest, frame);
    const bool particles = cache.layout.surfaceKind == SurfaceKind::particles && !cache.layout.fields.empty();
    frame.fields = furtherFields(cache, number, raw.geometry, *closest,
                                 particles ? 2.0 * radiusOf(cache, raw.geometry.points) : 0.0);
  }
  frame.surface = std::move(raw.surface);
  return frame;
}

double suitingVoxel(const Cache& cache, int number, const SurfaceTriangles& surface) {
  const SurfaceKind kind = cache.layout.surfaceKind;
  if (kind == SurfaceKind::mantaflow)
    return mantaflowPlace(cache, number).voxel * cache.options.unit * cache.options.scale;
  if (kind == SurfaceKind::levelSet || kind == SurfaceKind::fog) {
    const openvdb::FloatGrid::Ptr grid =
        readScalars(cache.layout.surface.at(number), cache.layout.surfaceName);
    const Mat3d voxel =
        (grid->transform().baseMap()->getAffineMap()->getMat4() * worldFromFile(cache.options)).getMat3();
    return std::cbrt(std::abs(voxel.det()));
  }
  if (kind == SurfaceKind::particles)
    return 2.0 * radiusOf(cache, readGeometry(cache.layout.surface.at(number)).points) * cache.options.unit *
           cache.options.scale;
  return meanEdge(surface);
}

double particleRadius(const Cache& cache, int number) {
  const fs::path& file = cache.layout.surface.at(number);
  return isEmptyFile(file) ? 0.0 : 0.5 * particleSpacing(readGeometry(file).points);
}

}  // namespace fluidtex::caches
