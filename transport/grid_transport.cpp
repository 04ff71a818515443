#include "transport/grid_transport.h"

#include "sim/grid/dilate.h"
#include "texture/loops/parallel.h"
#include "transport/within_reach.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::transport {

namespace {

// Upper bound on the displacement along an axis in the frame, metres.
double farthest(const Band& band, const sim::Frame& frame) {
  double sum = 0.0;
  for (const sim::Substep& substep : frame.substeps) {
    double fastest = 0.0;
    for (const Vec3d& u : velocityAtCells(band, substep))
      fastest = std::max({fastest, std::abs(u[0]), std::abs(u[1]), std::abs(u[2])});
    sum += fastest * substep.dt;
  }
  return sum;
}

sim::MaskTree cellsAround(const Band& band, const std::vector<Vec3f>& points, double reach) {
  sim::MaskTree mask;
  if (!(band.h > 0.0)) return mask;
  openvdb::tree::ValueAccessor<sim::MaskTree> mark(mask);
  for (const Vec3f& x : points) {
    const Vec3d index = (Vec3d(x) - band.origin) / band.h;
    if (withinReach(index)) mark.setValueOn(openvdb::Coord::round(index));
  }
  openvdb::tools::dilateActiveValues(mask, int(std::ceil(reach / band.h)),
                                     openvdb::tools::NN_FACE_EDGE_VERTEX, openvdb::tools::IGNORE_TILES);
  return mask;
}

}  // namespace

// The field is the displacement, coordinate - position: smooth beyond the rim too, where a cell without
// upwind neighbour keeps its value.
Backtrace traceOnGrid(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  const Band band = bandOf(frame);
  std::vector<Vec3d> displacement(band.cells.size(), Vec3d(0.0));
  advance(
      band, frame,
      [&](const auto& velocity, const auto& field, std::size_t cell, double dt) {
        return field[cell] - (velocity[cell] + upwindDerivative(band, velocity, field, cell)) * dt;
      },
      displacement);

  Backtrace trace;
  trace.origin.resize(positions.size());
  trace.map.resize(positions.size());
  trace.known.resize(positions.size());
  texture::forEachIndex(positions.size(), [&](std::uint32_t v) {
    const Vec3d x(positions[v]);
    const Corners corners = cornersAt(band, x);
    trace.origin[v] = x;
    trace.map[v].setIdentity();
    trace.known[v] = frame.substeps.empty() ? 1.0f : float(corners.known);
    if (!(corners.known > 0.0)) return;
    Vec3d moved(0.0);
    for (std::size_t i = 0; i < 8; ++i) {
      if (corners.cell[i] != Band::kNone)
        moved += displacement[std::size_t(corners.cell[i])] * corners.weight[i];
    }
    moved /= corners.known;
    trace.origin[v] += moved;
    for (std::size_t i = 0; i < 8; ++i) {
      if (corners.cell[i] == Band::kNone) continue;
      // Missing corners take the mean, whose slope is zero.
      const Vec3d value = displacement[std::size_t(corners.cell[i])] - moved;
      for (int axis = 0; axis < 3; ++axis)
        trace.map[v].setCol(axis, trace.map[v].col(axis) + value * corners.slope[i][axis]);
    }
  });
  return trace;
}

std::vector<Vec3f> directionsOnGrid(const std::vector<Vec3f>& positions, const sim::Frame& frame,
                                    const std::vector<Vec3f>& surface,
                                    const std::function<Vec3d(const Vec3d&)>& extended, bool turning) {
  const Band band = bandOf(frame);
  const sim::MaskTree near = cellsAround(band, surface, farthest(band, frame) + 2.0 * band.h);
  std::vector<Vec3d> direction(band.cells.size(), Vec3d(0.0));
  texture::forEachIndex(direction.size(), [&](std::uint32_t cell) {
    if (near.isValueOn(band.cells[cell])) direction[cell] = extended(band.center(cell));
  });
  advance(
      band, frame,
      [&](const auto& velocity, const auto& field, std::size_t cell, double dt) {
        const Vec3d& d = field[cell];
        Vec3d rate = -upwindDerivative(band, velocity, field, cell);
        if (turning) {
          const Vec3d along = velocityGradient(band, velocity, cell) * d;
          rate += along - d * d.dot(along);
        }
        // The length drifts where the flow compresses: renormalised in every step. As scalars the components
        // have no length to keep.
        Vec3d next = d + rate * dt;
        if (turning) next.normalize(0.0);
        return next;
      },
      direction);

  std::vector<Vec3f> result(positions.size(), Vec3f(0.0f));
  texture::forEachIndex(positions.size(), [&](std::uint32_t v) {
    const Corners corners = cornersAt(band, Vec3d(positions[v]));
    Vec3d sum(0.0);
    for (std::size_t i = 0; i < 8; ++i) {
      if (corners.cell[i] != Band::kNone) sum += direction[std::size_t(corners.cell[i])] * corners.weight[i];
    }
    result[v] = Vec3f(sum);
  });
  return result;
}

}  // namespace fluidtex::transport
