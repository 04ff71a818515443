#include "caches/liquid/further_fields.h"

#include "caches/formats/read_fields.h"
#include "caches/liquid/continue_outwards.h"
#include "caches/liquid/level_set.h"
#include "caches/liquid/particle_velocity.h"
#include "caches/liquid/placement.h"

#include <openvdb/tools/ValueTransformer.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace fluidtex::caches {
namespace {

using Fields = std::map<std::string, sim::FloatGrid::ConstPtr>;

// Cells around the surface in which attributes of a mesh are known, and layers that grids are continued by.
constexpr int kFieldReach = 6;

sim::FloatGrid::ConstPtr placed(const Cache& cache, openvdb::FloatGrid& grid) {
  continueOutwards(grid, kContinuedLayers);
  grid.transform().postMult(worldFromFile(cache.options));
  return sim::fromOpenVdb(grid);
}

// A component of vectors.
openvdb::FloatGrid::Ptr component(const openvdb::Vec3SGrid& vectors, int axis) {
  const auto tree = std::make_shared<openvdb::FloatTree>(vectors.tree(), 0.0f, openvdb::TopologyCopy());
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(tree);
  grid->setTransform(vectors.transform().copy());
  openvdb::tools::foreach (
      grid->beginValueOn(),
      [&](const openvdb::FloatGrid::ValueOnIter& value) {
        value.setValue(vectors.tree().getValue(value.getCoord())[axis]);
      },
      true, false);
  return grid;
}

void fromGrids(const Cache& cache, int number, const Field& field, Fields& fields) {
  const NumberedFiles& files = field.withVelocity ? cache.layout.velocity : cache.layout.surface;
  const std::vector<std::string> names = scalarNames(field);
  if (isEmptyFile(files.at(number))) return;
  if (!field.vectors) {
    fields[names.front()] = placed(cache, *readScalars(files.at(number), field.name));
    return;
  }
  const openvdb::Vec3SGrid::Ptr vectors = readVectors(files.at(number), field.name);
  for (int axis = 0; axis < 3; ++axis)
    fields[names[std::size_t(axis)]] = placed(cache, *component(*vectors, axis));
}

// Particles whose values are numbers, with three values each.
struct Known {
  std::vector<openvdb::Vec3f> points;
  std::vector<float> values;
};

Known knownOf(const Geometry& geometry, const Attribute& attribute) {
  Known known;
  for (std::size_t n = 0; n < geometry.points.size(); ++n) {
    std::array<float, 3> three{};
    bool finite = true;
    for (int c = 0; c < attribute.components; ++c) {
      three[std::size_t(c)] = attribute.values[n * std::size_t(attribute.components) + std::size_t(c)];
      finite = finite && std::isfinite(three[std::size_t(c)]);
    }
    if (!finite) continue;
    known.points.push_back(geometry.points[n]);
    known.values.insert(known.values.end(), three.begin(), three.end());
  }
  return known;
}

void fromPoints(const Cache& cache, const Field& field, const Geometry& geometry, ClosestTriangles& closest,
                double spacing, Fields& fields) {
  const auto found = geometry.attributes.find(field.name);
  const int components = field.vectors ? 3 : 1;
  if (found == geometry.attributes.end() || found->second.components != components) return;
  const std::vector<std::string> names = scalarNames(field);
  if (cache.layout.surfaceKind == SurfaceKind::mesh) {
    const auto grids = continuedOff(closest, found->second.values, components, kFieldReach);
    for (std::size_t c = 0; c < names.size(); ++c) fields[names[c]] = sim::fromOpenVdb(*grids[c]);
    return;
  }
  const Known known = knownOf(geometry, found->second);
  const openvdb::Vec3SGrid::Ptr between = velocityOfParticles(known.points, known.values, spacing);
  for (std::size_t c = 0; c < names.size(); ++c)
    fields[names[c]] = placed(cache, *component(*between, int(c)));
}

}  // namespace

Fields furtherFields(const Cache& cache, int number, const Geometry& geometry, ClosestTriangles& closest,
                     double spacing) {
  Fields fields;
  const SurfaceKind kind = cache.layout.surfaceKind;
  const bool atPoints = kind == SurfaceKind::mesh || kind == SurfaceKind::particles;
  for (const Field& field : cache.layout.fields) {
    if (atPoints && !field.withVelocity)
      fromPoints(cache, field, geometry, closest, spacing, fields);
    else
      fromGrids(cache, number, field, fields);
  }
  return fields;
}

}  // namespace fluidtex::caches
