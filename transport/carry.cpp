#include "transport/carry.h"

#include "texture/labels/chips.h"
#include "texture/labels/fresh.h"
#include "texture/labels/pieces.h"
#include "texture/loops/parallel.h"
#include "texture/mesh/vertex_graph.h"
#include "texture/orientation/tangent.h"
#include "texture/vertex_arrays.h"
#include "transport/backtrace.h"
#include "transport/closest_point.h"
#include "transport/cubic_directions.h"
#include "transport/grid_transport.h"
#include "transport/inflow.h"
#include "transport/pick_up.h"
#include "transport/trust.h"
#include "transport/turn_with_flow.h"
#include "transport/velocity_sampler.h"

#include <openvdb/tools/Interpolation.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fluidtex::transport {
namespace {

using texture::Carried;
using texture::SurfaceMesh;
using texture::TexturedSurface;
using texture::Vec3f;

// Least length scale of trust: surfaces closer than half a voxel, or than the spacing, cannot be told apart.
double halfVoxel(const sim::Frame& frame) {
  double voxel = 0.0;
  if (!frame.substeps.empty()) voxel = VelocitySampler(frame.substeps.back()).voxelSize();
  if (voxel == 0.0 && frame.surfacePhi) voxel = frame.surfacePhi->voxelSize().x();
  return 0.5 * voxel;
}

// The previous surface, with its acceleration structure.
struct Source {
  const TexturedSurface& surface;
  ClosestPoint closest;
  std::vector<Vec3f> slopes;  // of the angle of the orientation
  int symmetry;

  // penalty: metres, for facing the other way.
  Landing landing(const Vec3d& x, const Vec3f& normal, double penalty) const {
    return landingAt(surface, closest.nearest(x, normal, penalty));
  }
  Vec3f direction(const Landing& landing) const { return directionAt(surface, slopes, landing, symmetry); }
};

// The paper's orientation: extended off the old surface and advected on the grid. 0 beyond the band.
std::vector<Vec3f> gridOrientation(const Source& source, const sim::Frame& frame, const SurfaceMesh& next,
                                   bool turning) {
  const auto extended = [&](const Vec3d& x) {
    return Vec3d(source.direction(landingAt(source.surface, source.closest.nearest(x, Vec3f(0.0f), 0.0))));
  };
  return directionsOnGrid(next.positions, frame, source.surface.positions, extended, turning);
}

// Above it, every component is partly known; below, the slope is 0.
constexpr double kAllKnown = 0.7;

// d(velocity) / d(axis) by differences over `h` to both sides, or to the side where velocity is known.
Vec3d slopeAt(VelocitySampler& sampler, const Vec3d& x, int axis, double h) {
  Vec3d step(0.0);
  step[axis] = h;
  const auto known = [](const VelocitySample& sample) { return sample.known > kAllKnown; };
  const WallSide side = sampler.sideOf(x);
  VelocitySample ahead = sampler.velocity(x + step, side), behind = sampler.velocity(x - step, side);
  double width = 2.0 * h;
  if (known(ahead) != known(behind)) {
    (known(ahead) ? behind : ahead) = sampler.velocity(x);
    width = h;
  }
  return known(ahead) && known(behind) ? (ahead.velocity - behind.velocity) / width : Vec3d(0.0);
}

// Checks that arrays have one entry per vertex. (ClosestPoint checks the triangles' vertices.)
void checkSizes(const TexturedSurface& previous, const SurfaceMesh& next, int symmetry) {
  if (symmetry < 1) throw std::invalid_argument("carry: the symmetry must be 1 or more");
  if (next.normals.size() != next.positions.size())
    throw std::invalid_argument("carry: the new mesh must have one normal per vertex");
  const auto check = [&](const auto& values, texture::Array array) {
    if (!texture::fits(values, array, previous.positions.size()))
      throw std::invalid_argument("carry: the last surface's arrays must have one entry per vertex");
  };
  texture::forEachMeshArray(previous, check);
  texture::forEachTextureArray(previous, check);
}

}  // namespace

std::vector<Vec3f> moved(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  return traceForward(positions, frame);
}

std::vector<Vec3f> velocityAt(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  std::vector<Vec3f> result(positions.size(), Vec3f(0.0f));
  if (frame.substeps.empty()) return result;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      VelocitySampler sampler(frame.substeps.back());
                      for (std::size_t v = range.begin(); v != range.end(); ++v) {
                        result[v] = Vec3f(sampler.velocity(Vec3d(positions[v])).velocity);
                      }
                    });
  return result;
}

std::array<std::vector<Vec3f>, 3> velocitySlopes(const std::vector<Vec3f>& positions,
                                                 const sim::Frame& frame) {
  std::array<std::vector<Vec3f>, 3> slope;
  slope.fill(std::vector<Vec3f>(positions.size(), Vec3f(0.0f)));
  if (frame.substeps.empty()) return slope;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      VelocitySampler sampler(frame.substeps.back());
                      const double h = sampler.voxelSize();
                      for (std::size_t v = range.begin(); v != range.end(); ++v)
                        for (std::size_t axis = 0; axis < 3; ++axis)
                          slope[axis][v] = Vec3f(slopeAt(sampler, Vec3d(positions[v]), int(axis), h));
                    });
  return slope;
}

std::vector<std::uint8_t> contactAt(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  std::vector<std::uint8_t> result(positions.size(), 0);
  if (!frame.solidPhi) return result;
  const sim::FloatGrid& solid = *frame.solidPhi;
  const auto limit = float(0.5 * solid.voxelSize().x());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const auto accessor = solid.getConstAccessor();
                      for (std::size_t v = range.begin(); v != range.end(); ++v) {
                        const Vec3d index = solid.worldToIndex(Vec3d(positions[v]));
                        result[v] = openvdb::tools::BoxSampler::sample(accessor, index) < limit ? 1 : 0;
                      }
                    });
  return result;
}

texture::Carried carry(const TexturedSurface& previous, const sim::Frame& frame, const SurfaceMesh& next,
                       int symmetry, const Options& options) {
  Carried carried;
  if (previous.empty() || previous.triangles.empty()) return carried;
  checkSizes(previous, next, symmetry);
  const std::size_t count = next.positions.size();
  const bool onGrid = options.method == Method::grid, turning = options.orientation == Turning::vector;
  const double least = halfVoxel(frame);
  Backtrace trace = onGrid ? traceOnGrid(next.positions, frame) : traceBack(next.positions, frame);
  const Source source{previous, ClosestPoint(previous.positions, previous.triangles),
                      angleSlopes(previous, symmetry), symmetry};
  std::vector<Vec3f> fromGrid;
  if (onGrid) fromGrid = gridOrientation(source, frame, next, turning);

  texture::forEachTextureArray(carried, [&](auto& values, texture::Array) { values.resize(count); });
  carried.fading = texture::noFading(count);
  carried.orientation.resize(count);
  if (!previous.foam.empty()) carried.foam.resize(count);
  if (previous.original.empty()) carried.original.clear();
  if (previous.rest.empty()) carried.rest.clear();
  if (previous.secondRest.empty()) carried.secondRest.clear();
  std::vector<float> stretched(count);
  std::vector<Inflow> inflow(count, Inflow::none);
  std::vector<std::uint8_t>& stays = carried.stays;
  stays.assign(count, 0);
  std::vector<Vec3f> way(count);
  const auto place = [&](std::uint32_t v, bool mayStay) {
    Mat3d map = trace.map[v];
    const double scale = std::max(least, next.spacingAt(v));
    const Vec3f& normal = next.normals[v];
    const Vec3f oldNormal = carriedNormal(normal, map);
    Landing landing = source.landing(trace.origin[v], oldNormal, kOtherSide * scale);
    const TracedVertex vertex{Vec3d(next.positions[v]), trace.origin[v], normal, oldNormal,
                              next.spacingAt(v)};
    float trust = landingTrust(landing, scale, oldNormal) * trace.known[v];
    inflow[v] = inflowAt(vertex, landing);
    stays[v] = 0;
    if (mayStay && goesThrough(vertex, landing)) {
      const Landing here = source.landing(vertex.position, normal, kOtherSide * scale);
      const float trustHere = landingTrust(here, scale, normal);
      stays[v] = trustHere >= texture::kLowTrust && hasStayed(vertex, here);
      if (stays[v]) landing = here, map = Mat3d::identity(), trust = trustHere;
    }
    way[v] = Vec3f(vertex.position - vertex.origin);

    const Texel texel = texelAt(previous, previous.coordinate, previous.gradient, landing, map, normal);
    carried.coordinate[v] = texel.coordinate;
    carried.gradient[v] = texel.gradient;
    pickUpFading(previous, landing, map, normal, v, carried.fading);
    carried.color[v] = colorAt(previous, landing);
    carried.age[v] = valueAt(previous.age, landing);
    if (!carried.rest.empty()) carried.rest[v] = valueAt(previous.rest, landing);
    if (!carried.secondRest.empty()) carried.secondRest[v] = valueAt(previous.secondRest, landing);
    if (!carried.original.empty()) carried.original[v] = previous.original[landing.nearestVertex()];
    if (!carried.foam.empty()) carried.foam[v] = valueAt(previous.foam, landing);
    const Vec3f direction = source.direction(landing);
    if (onGrid)
      carried.orientation[v] = texture::tangentUnit(
          fromGrid[v], normal, texture::tangentUnit(direction, normal, anyTangent(normal)));
    else if (turning)
      carried.orientation[v] = turnedWithFlow(direction, map, normal);
    else
      carried.orientation[v] = texture::tangentUnit(direction, normal, anyTangent(normal));
    carried.trust[v] = trust;
    stretched[v] = stretchTrust(texel.gradient, previous.spacing * next.spacingAt(v) / next.spacing);
    const bool onOld = inflow[v] != Inflow::out && !stays[v];
    carried.previousPosition[v] = Vec3f(onOld ? landing.point.position : vertex.origin);
  };
  texture::forEachIndex(count, [&](std::uint32_t v) { place(v, true); });
  texture::VertexGraph graph;
  if (texture::any(stays) || anyOut(inflow)) graph = texture::buildVertexGraph(next);
  if (texture::any(stays)) {
    // So few that they would be a chip are no surface that stays.
    const std::vector<std::uint8_t> through = stays;
    texture::forEachPiece(graph, through, [&](const std::vector<std::uint32_t>& piece) {
      if (piece.size() >= texture::kChip) return;
      for (const std::uint32_t v : piece) place(v, false);
    });
    for (std::uint32_t v = 0; v < count; ++v)
      if (stays[v]) trace.map[v] = Mat3d::identity();
  }
  const std::vector<float> neighbors = neighborTrust(next, carried.previousPosition, trace.map, stays);
  texture::forEachIndex(count, [&](std::uint32_t v) {
    const float trust = carried.trust[v] * neighbors[v];
    carried.trust[v] = std::isfinite(trust) ? std::min(trust, stretched[v]) : 0.0f;
  });
  drawOut(next, graph, {previous, true}, inflow, way, symmetry, carried);
  return carried;
}

}  // namespace fluidtex::transport
