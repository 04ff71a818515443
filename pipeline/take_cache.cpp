#include "pipeline/take_cache.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::pipeline {
namespace {

using sim::Vec3d;

constexpr int kFewestCells = 8, kMostCells = 4096;  // of domain.resolution

double longestOf(const Vec3d& size) {
  return std::max({size[0], size[1], size[2]});
}

void takeFrames(const caches::Layout& layout, scenes::Scene& scene) {
  if (scene.frames == 0) scene.frames = std::min(layout.frames(), 9999);
  if (scene.frames > layout.frames())
    throw caches::LayoutError(
        fmt::format("{}: has {} frames from number {} on, and the scene {}; give frames = {}",
                    scene.files.path.string(), layout.frames(), layout.first, scene.frames, layout.frames()));
  scene.onto.last = scene.onto.first + scene.frames - 1;
}

void takeBounds(const openvdb::BBoxd& bounds, double voxel, scenes::Scene& scene) {
  if (scene.sim.size[0] > 0.0) return;
  const Vec3d extents = bounds.extents();
  for (int axis = 0; axis < 3; ++axis) scene.sim.size[axis] = std::max(extents[axis], 4.0 * voxel);
  scene.sim.resolution =
      std::clamp(int(std::ceil(longestOf(scene.sim.size) / voxel)), kFewestCells, kMostCells);
}

// As the default view frames its domain.
void takeView(const openvdb::BBoxd& bounds, render::Camera& camera) {
  const render::Camera view;
  if (std::isnan(camera.at[0])) camera.at = bounds.getCenter();
  if (std::isnan(camera.from[0]))
    camera.from = camera.at + (view.from - view.at) * longestOf(bounds.extents());
}

}  // namespace

caches::Survey takeCache(scenes::Scene& scene) {
  caches::Survey survey = caches::survey(scene.files);
  scene.files.voxel = survey.voxel;
  scene.files.first = survey.layout.first;
  takeFrames(survey.layout, scene);
  takeBounds(survey.bounds, survey.voxel, scene);
  takeView(survey.bounds, scene.render.camera);
  return survey;
}

}  // namespace fluidtex::pipeline
