#include "sim/flows/flows.h"

#include "sim/grid/block_samples.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/normal.h"
#include "sim/solids/domain.h"
#include "sim/surface/level_set.h"

#include <openvdb/tools/Interpolation.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

// A source's surface is its front where its normal has more than this share along the velocity.
constexpr double kFront = 0.1;
// Liquid less than this many cells thick on a source's side has crept there; with more, the source is under
// water.
constexpr double kBare = 0.25;

// The value of a curve, constant before its first point and after its last one.
double rateAt(const std::vector<RatePoint>& rate, double t) {
  if (rate.empty()) return 1.0;
  if (t <= rate.front().time) return rate.front().factor;
  for (std::size_t n = 1; n < rate.size(); ++n) {
    if (t > rate[n].time) continue;
    const double share = (t - rate[n - 1].time) / (rate[n].time - rate[n - 1].time);
    return rate[n - 1].factor + share * (rate[n].factor - rate[n - 1].factor);
  }
  return rate.back().factor;
}

std::vector<FloatLeaf*> touchLeaves(FloatGrid& phi, const std::vector<Coord>& origins) {
  std::vector<FloatLeaf*> leaves;
  leaves.reserve(origins.size());
  for (const Coord& origin : origins) leaves.push_back(phi.tree().touchLeaf(origin));
  return leaves;
}

// Whether air lies just outside the source's surface there, on a side other than its front. place: a cell;
// distance: the source's there. Not in solids, where phi says nothing of air: a side that counted as bare
// there would take in the liquid of a full room forever.
bool bareSide(const FloatGrid& phi, const FloatGrid& solidPhi, const FloatGrid& shape, const Coord& place,
              float distance, const Vec3d& velocity) {
  const double h = phi.voxelSize()[0];
  const Vec3d normal = normalAt(shape.constTree(), place);
  if (normal == Vec3d(0.0) || normal.dot(velocity) > kFront * velocity.length()) return false;
  const Vec3d outside = place.asVec3d() + (kBare - distance / h) * normal;
  using openvdb::tools::BoxSampler;
  return BoxSampler::sample(solidPhi.constTree(), outside) > 0.0f &&
         BoxSampler::sample(phi.constTree(), outside) > 0.0f;
}

// phi = min(phi, source). Where the sides of a flowing source are bare they are the surface: liquid that has
// crept over them is removed, or the little that rises there would draw up more.
void fill(FloatGrid& phi, const FloatGrid& solidPhi, const SourceGrids& source) {
  const std::vector<FloatLeaf*> leaves = touchLeaves(phi, wetLeaves(*source.phi, CoordBBox::inf()));
  const float background = phi.background(), band = 2.0f * static_cast<float>(phi.voxelSize()[0]);
  std::vector<std::array<float, kLeafSize>> filled(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float scratch[kLeafSize];
    const float* liquid = leafValues(source.phi->constTree(), leaves[n]->origin(), scratch);
    const float* was = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i) {
      const bool bare =
          source.speed != Vec3d(0.0) && std::abs(liquid[i]) < band &&
          bareSide(phi, solidPhi, *source.phi, leaves[n]->offsetToGlobalCoord(i), liquid[i], source.speed);
      filled[n][i] = std::clamp(bare ? liquid[i] : std::min(was[i], liquid[i]), -background, background);
    }
  });
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    std::copy_n(filled[n].data(), kLeafSize, leaves[n]->buffer().data());
  });
}

// phi = max(phi, -drain).
void empty(FloatGrid& phi, const FloatGrid& drain) {
  const std::vector<FloatLeaf*> leaves = touchLeaves(phi, wetLeaves(phi, drain.evalActiveVoxelBoundingBox()));
  const float background = phi.background();
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float scratch[kLeafSize];
    const float* shape = leafValues(drain.constTree(), leaves[n]->origin(), scratch);
    float* values = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i)
      values[i] = std::clamp(std::max(values[i], -shape[i]), -background, background);
  });
}

// Drops the liquid markers, or the air markers, that lie in the shape. Just those: air markers left at a
// source's sides fall with its liquid and groove the sheet.
void dropWithin(Markers& markers, const FloatGrid& shape, bool ofLiquid) {
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    thread_local BlockSamples distance(1);
    distance.load(shape.constTree(), markers[n].origin);
    const auto inside = [](float value) { return value < 0.0f; };
    if (std::none_of(distance.value.begin(), distance.value.end(), inside)) return;
    std::erase_if(markers[n].markers, [&](const Marker& m) {
      return (m.radius < 0.0f) == ofLiquid && inside(distance.at(m.x, m.y, m.z));
    });
  });
  std::erase_if(markers, [](const MarkerBlock& block) { return block.markers.empty(); });
}

// Bounding box of the liquid in these cells.
CoordBBox boxAround(const FloatGrid& phi, const CoordBBox& cells) {
  CoordBBox box;
  for (const Coord& origin : wetLeaves(phi, cells)) box.expand(CoordBBox::createCube(origin, kLeafDim));
  box.intersect(cells);
  return box;
}

// Depth of the liquid in the column of cells through `cell` along `down`, metres. box: bounds of the liquid.
double depthOf(const FloatGrid& phi, const SolidField& solid, const CoordBBox& box, Coord cell, int down) {
  const auto liquid = phi.getConstUnsafeAccessor();
  const auto wall = solid.phi->getConstUnsafeAccessor();
  double depth = 0.0;
  for (cell[down] = box.min()[down]; cell[down] <= box.max()[down]; ++cell[down]) {
    const double p = std::max(liquid.getValue(cell), -wall.getValue(cell));
    depth += std::clamp(0.5 * solid.voxelSize - p, 0.0, solid.voxelSize);
  }
  return depth;
}

// Gives one stream side of the domain the velocity that arrives there by the end of the step.
void giveStream(GivenFaces& given, int side, const SolidField& solid, const FloatGrid& phi,
                const Velocity& before, const Vec3d& gravity, double dt) {
  const int axis = side / 2, out = side % 2 == 0 ? -1 : 1;
  const auto& open = solid.open.component;
  const auto share = open[axis]->getConstUnsafeAccessor();
  const auto liquid = phi.getConstUnsafeAccessor();
  const auto speed = before.component[axis]->getConstUnsafeAccessor();
  int down = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(gravity[a]) > std::abs(gravity[down])) down = a;
  const int across = 3 - axis - down;
  const double h = solid.voxelSize;
  CoordBBox layer = solid.domain;  // of cells beside the side
  if (out > 0) {
    layer.min()[axis] = layer.max()[axis];
  } else {
    layer.max()[axis] = layer.min()[axis];
  }
  const CoordBBox box = boxAround(phi, layer);
  // Shallow-water waves run along the surface only: there are none where the side is the floor or the
  // ceiling.
  const bool waves = axis != down;
  const int beside = waves ? across : (axis + 1) % 3, along = waves ? down : (axis + 2) % 3;
  for (int i = box.min()[beside]; i <= box.max()[beside]; ++i) {
    double wave = -1.0;
    for (int j = box.min()[along]; j <= box.max()[along]; ++j) {
      Coord cell;
      cell[axis] = layer.min()[axis];
      cell[beside] = i;
      cell[along] = j;
      Coord face = cell;
      if (out > 0) face[axis] += 1;
      if (liquid.getValue(cell) >= 0.0f || share.getValue(face) <= 0.0f) continue;
      if (wave < 0.0)
        wave = waves ? std::sqrt(std::abs(gravity[down]) * depthOf(phi, solid, box, cell, down)) : 0.0;
      const double here = out * speed.getValue(face);
      const double back = std::clamp((here + wave) * dt / h, 0.0, kLeafDim - 1.0);
      // The faces inwards from the side, as far as they are open.
      const auto valueAt = [&](int steps) {
        Coord at = face, last = face;
        for (int n = 0; n < steps; ++n) {
          at[axis] -= out;
          if (share.getValue(at) <= 0.0f || !speed.isValueOn(at)) break;
          last = at;
        }
        return static_cast<double>(speed.getValue(last));
      };
      const int whole = static_cast<int>(back);
      const double near = valueAt(whole), far = valueAt(whole + 1);
      given.set(axis, face, static_cast<float>(near + (back - whole) * (far - near)));
    }
  }
}

}  // namespace

Flows::Flows(const Options& options)
    : m_sources(options.sources),
      m_drains(options.drains),
      m_h(options.voxelSize()),
      m_domain(domainCells(options)),
      m_box(domainBox(options)),
      m_band(bandWidth(options.cfl) * m_h) {
  const auto distanceTo = [&](const Shape& shape) { return ShapeDistance(shape, m_h, m_box); };
  for (const Source& source : m_sources) {
    const ShapeDistance shape = distanceTo(source.shape);
    SourceGrids grids{gridOf(shape), source.velocity, source.temperature, source.mixture, {}, shape};
    if (source.velocity != Vec3d(0.0)) grids.velocity = sourceFaces(*grids.phi, source.velocity, m_domain);
    m_sourceGrids.push_back(std::move(grids));
  }
  for (const Drain& drain : m_drains) m_drainGrids.push_back(gridOf(distanceTo(drain.shape)));
}

FloatGrid::Ptr Flows::gridOf(const ShapeDistance& shape) const {
  FloatGrid::Ptr phi = makePhi(m_h, m_band);
  unite(*phi, shape, m_domain);
  return phi;
}

RunningFlows Flows::at(double t) const {
  RunningFlows running;
  for (std::size_t n = 0; n < m_sources.size(); ++n) {
    const double factor = rateAt(m_sources[n].rate, t);
    if (m_sources[n].from <= t && t < m_sources[n].until && factor > 0.0)
      running.sources.push_back({&m_sourceGrids[n], factor});
  }
  for (std::size_t n = 0; n < m_drains.size(); ++n)
    if (m_drains[n].from <= t && t < m_drains[n].until) running.drains.push_back(m_drainGrids[n].get());
  return running;
}

double Flows::nextChange(double t) const {
  double next = kForever;
  const auto consider = [&](double time) {
    if (time > t) next = std::min(next, time);
  };
  for (const Source& source : m_sources) {
    consider(source.from);
    consider(source.until);
    for (const RatePoint& point : source.rate) consider(point.time);
  }
  for (const Drain& drain : m_drains) {
    consider(drain.from);
    consider(drain.until);
  }
  return next;
}

std::vector<const FloatGrid*> Flows::places() const {
  std::vector<const FloatGrid*> grids;
  for (const SourceGrids& source : m_sourceGrids) grids.push_back(source.phi.get());
  return grids;
}

void applyFlows(FloatGrid& phi, Markers& markers, const FloatGrid& solidPhi, const RunningFlows& flows) {
  for (const auto& [source, factor] : flows.sources) {
    fill(phi, solidPhi, *source);
    dropWithin(markers, *source->phi, false);
  }
  for (const FloatGrid* drain : flows.drains) {
    empty(phi, *drain);
    dropWithin(markers, *drain, true);
  }
}

SolidField withFlows(const SolidField& solid, const RunningFlows& flows, const FloatGrid& phi,
                     const Velocity& before, const Vec3d& gravity, double dt) {
  SolidField field = solid;
  const bool streams = std::find(solid.sides.begin(), solid.sides.end(), Side::stream) != solid.sides.end();
  const bool moving = std::any_of(flows.sources.begin(), flows.sources.end(),
                                  [](const auto& running) { return running.source->velocity[0] != nullptr; });
  if (!streams && !moving) return field;
  GivenFaces given;
  for (int axis = 0; axis < 3; ++axis) {
    given.grid[axis] = FloatGrid::create(kNotGiven);
    given.grid[axis]->setTransform(faceTransform(solid.voxelSize, axis));
  }
  for (int side = 0; side < 6; ++side)
    if (solid.sides[side] == Side::stream) giveStream(given, side, solid, phi, before, gravity, dt);
  for (const auto& [source, factor] : flows.sources)
    if (source->velocity[0] != nullptr) giveSource(given, *source, factor, solid);
  field.given = {given.grid};
  return field;
}

}  // namespace fluidtex::sim
