#include "pipeline/given_flow.h"

#include "caches/liquid/cells_crossed.h"
#include "caches/liquid/explained.h"
#include "caches/liquid/level_set.h"
#include "caches/liquid/substeps.h"
#include "caches/liquid/surface_velocity.h"
#include "caches/liquid/velocity_grids.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fluidtex::pipeline {
namespace {

using caches::LiquidFrame;
using openvdb::Vec3d;
using openvdb::Vec3f;

// Cells around the surface in which velocities are used.
constexpr double kReach = 24.0;

bool isFinite(const Vec3f& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

// By leaves, as tiles are constant and those of level sets say no more than inside or outside.
template <class Grid, class Finite>
void checkFinite(const Grid& grid, const char* name, const Finite& finite) {
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      if (finite(*value)) continue;
      const openvdb::Coord at = value.getCoord();
      throw std::invalid_argument(
          fmt::format("{}: is not finite at voxel ({}, {}, {}); give numbers", name, at[0], at[1], at[2]));
    }
}

void checkSize(const caches::SurfaceTriangles& surface, double h) {
  const caches::CellsCrossed crossed = caches::cellsCrossed(surface, h);
  if (!crossed.fits(h))
    throw std::invalid_argument(fmt::format(
        "the surface crosses {:.3g} cells of {:.3g} m, up to {:.3g} m from the origin, which is too many or "
        "too far; look for stray points in it, or give larger cells",
        crossed.cells, h, crossed.farthest));
}

void checkMesh(const caches::SurfaceTriangles& mesh, const std::vector<Vec3f>& velocity, double h) {
  if (!(h > 0.0 && std::isfinite(h)))
    throw std::invalid_argument(fmt::format("a level set with cells of {} m cannot be; give more than 0", h));
  for (const openvdb::Vec3I& t : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner)
      if (t[corner] >= mesh.points.size())
        throw std::invalid_argument(
            fmt::format("a triangle has point {} as a corner; there are {}, counted from 0", t[corner],
                        mesh.points.size()));
  if (!std::all_of(mesh.points.begin(), mesh.points.end(), isFinite))
    throw std::invalid_argument("a point of the mesh is not finite; give numbers");
  if (!std::all_of(velocity.begin(), velocity.end(), isFinite))
    throw std::invalid_argument("the velocity of a point is not finite; give numbers");
  if (!velocity.empty() && velocity.size() != mesh.points.size())
    throw std::invalid_argument(fmt::format("there are {} velocities and {} points; give one for each",
                                            velocity.size(), mesh.points.size()));
}

}  // namespace

LiquidFrame liquidOf(const openvdb::FloatGrid& phi, const openvdb::Vec3SGrid::Ptr& velocity) {
  const double h = phi.voxelSize()[0];
  if (!phi.hasUniformVoxels()) {
    const Vec3d sides = phi.voxelSize();
    throw std::invalid_argument(fmt::format(
        "the level set's voxels are {:.3g} x {:.3g} x {:.3g} m; give cubes", sides[0], sides[1], sides[2]));
  }
  checkFinite(phi, "the level set", [](float value) { return std::isfinite(value); });
  LiquidFrame frame;
  frame.surface = caches::surfaceOfGrid(phi, 0.0);
  checkSize(frame.surface, h);
  caches::LevelSet levelSet = caches::levelSetOf(frame.surface, h);
  frame.phi = std::move(levelSet.phi);
  frame.isSheet = levelSet.isSheet;
  if (velocity) {
    checkFinite(*velocity, "the velocity", isFinite);
    const caches::RawVelocity raw{
        velocity, {}, false, openvdb::Mat4d::identity(), openvdb::Mat3d::identity()};
    frame.velocity = caches::velocityGrids(raw, *frame.phi, kReach * h);
  }
  return frame;
}

LiquidFrame liquidOf(caches::SurfaceTriangles mesh, const std::vector<Vec3f>& velocity, double h,
                     double seconds) {
  checkMesh(mesh, velocity, h);
  checkSize(mesh, h);
  LiquidFrame frame;
  frame.surface = std::move(mesh);
  caches::ClosestTriangles closest(frame.surface, h);
  caches::LevelSet levelSet = caches::levelSetOf(closest);
  frame.phi = std::move(levelSet.phi);
  frame.isSheet = levelSet.isSheet;
  if (!velocity.empty()) {
    std::vector<float> numbers;
    numbers.reserve(3 * velocity.size());
    for (const Vec3f& v : velocity) numbers.insert(numbers.end(), {v[0], v[1], v[2]});
    frame.velocity = caches::velocityOffSurface(closest, numbers, caches::reachInCells(numbers, seconds, h));
  }
  return frame;
}

sim::Frame GivenFlow::next(LiquidFrame now, double seconds) {
  if (!(seconds > 0.0 && std::isfinite(seconds)))
    throw std::invalid_argument(fmt::format("a frame of {} s cannot be; give more than 0", seconds));
  sim::Frame frame;
  frame.index = m_frame + 1;
  frame.time = m_last ? m_time + seconds : 0.0;
  if (m_last) {
    const sim::FaceGrids &begin = m_last->velocity, &end = now.velocity;
    if (begin && end) {
      const caches::FrameMotion motion = caches::bestMotion(*m_last->phi, *now.phi, begin, end, seconds);
      frame.substeps = caches::substepsOf(begin, end, motion.meanWeight, seconds);
      frame.stats.explained = motion.explained;
    } else if (begin || end) {
      frame.substeps = caches::substepsOf(begin, end, begin ? 0.0 : 1.0, seconds);
    }
    if (!frame.substeps.empty()) frame.stats.dtMin = frame.substeps.front().dt;
  }
  frame.surfacePhi = now.phi;
  frame.fields = now.fields;
  now.surface = {};  // the next frame asks for grids only
  m_last = std::move(now);
  m_frame = frame.index;
  m_time = frame.time;
  return frame;
}

}  // namespace fluidtex::pipeline
