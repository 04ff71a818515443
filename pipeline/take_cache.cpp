#include "pipeline/take_cache.h"

#include "caches/liquid/survey.h"
#include "caches/recorded/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::pipeline {
namespace {

using sim::Vec3d;

// Of a liquid that fills the picture in the default view.
constexpr double kDiagonalOfView = 1.6;

constexpr int kFewestCells = 8, kMostCells = 4096;  // of domain.resolution

double longestOf(const Vec3d& size) {
  return std::max({size[0], size[1], size[2]});
}

void takeFrames(int frames, int first, scenes::Scene& scene) {
  if (scene.frames == 0 && scene.files.follow)
    throw caches::LayoutError(fmt::format(
        "{}: {} frames are there, and it is not known how many there will be; give --set frames=N with "
        "--follow",
        scene.files.path.string(), frames));
  if (scene.frames == 0) scene.frames = std::min(frames, 9999);
  if (scene.frames > frames && !scene.files.follow)
    throw caches::LayoutError(
        fmt::format("{}: has {} frames from number {} on, and the scene {}; give frames = {}",
                    scene.files.path.string(), frames, first, scene.frames, frames));
  scene.onto.last = scene.onto.first + scene.frames - 1;
}

// A file that is missing is better known now than in the middle of the run.
void requireFiles(const caches::Layout& layout, int frames) {
  for (int number = layout.first; number < layout.first + frames; ++number)
    for (const caches::NumberedFiles* files : {&layout.surface, &layout.velocity, &layout.config})
      if (!files->empty()) files->at(number);
}

// What the texture is to follow should be among what the files have.
void requireAttributes(const caches::Layout& layout, const scenes::Scene& scene) {
  std::vector<std::string> there;
  for (const caches::Field& field : layout.fields)
    for (const std::string& name : caches::scalarNames(field)) there.push_back(name);
  const auto require = [&](bool used, const std::string& key, const std::string& name) {
    if (!used || std::find(there.begin(), there.end(), name) != there.end()) return;
    throw caches::LayoutError(fmt::format("{}: the liquid in {} has no {}; there {}", key,
                                          scene.files.path.string(), name,
                                          there.empty() ? "is nothing besides surface and velocity"
                                                        : fmt::format("are: {}", fmt::join(there, ", "))));
  };
  const texture::GuidanceOptions& guidance = scene.texture.guidance;
  require(guidance.by == texture::GuidanceBy::attribute, "texture.guidance.attribute", guidance.attribute);
  require(guidance.by == texture::GuidanceBy::temperature, "texture.guidance.by", "temperature");
  require(guidance.by == texture::GuidanceBy::mixture, "texture.guidance.by", "mixture");
  const auto requireFactor = [&](const texture::FactorOptions& factor, const std::string& path) {
    require(factor.by == texture::FactorBy::attribute, path + ".attribute", factor.attribute);
    require(factor.by == texture::FactorBy::temperature, path + ".by", "temperature");
  };
  requireFactor(scene.texture.scale, "texture.scale");
  requireFactor(scene.texture.renewal, "texture.renewal");
  const texture::OrientationOptions& orientation = scene.texture.orientation;
  require(orientation.align == texture::Align::attribute, "texture.orientation.attribute",
          orientation.attribute + "_x");
}

void takeBounds(const openvdb::BBoxd& bounds, double voxel, scenes::Scene& scene) {
  if (scene.sim.size[0] > 0.0) return;
  scene.domainOrigin = bounds.min();
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
    camera.from = camera.at + (view.from - view.at) * (bounds.extents().length() / kDiagonalOfView);
}

// Of the program's own frames: the domain that they were made in, seen as always.
std::vector<std::string> takeRecording(scenes::Scene& scene) {
  const caches::Recording recording = caches::openRecording(scene.files.path);
  if (scene.files.follow)
    throw caches::LayoutError(scene.files.path.string() +
                              ": holds frames of fluidtex itself, which --follow does not wait for; let "
                              "`fluidtex simulate` end first, or leave --follow out");
  takeFrames(recording.frames, 1, scene);
  if (scene.sim.size[0] == 0.0) {
    scene.sim.size = recording.sim.size;
    scene.sim.resolution = recording.sim.resolution;
    scene.sim.sides = recording.sim.sides;
    takeView(openvdb::BBoxd(Vec3d(0.0), scene.sim.size), scene.render.camera);
  }
  return {fmt::format("cache     recorded by fluidtex, frames 1 to {}", recording.frames)};
}

}  // namespace

std::vector<std::string> takeCache(scenes::Scene& scene) {
  if (caches::isRecording(scene.files.path)) return takeRecording(scene);
  const caches::Survey survey = caches::survey(scene.files);
  scene.files.voxel = survey.voxel;
  if (survey.radius > 0.0) scene.files.radius = survey.radius;
  scene.files.first = survey.layout.first;
  takeFrames(survey.layout.frames(), survey.layout.first, scene);
  requireFiles(survey.layout, std::min(scene.frames, survey.layout.frames()));
  requireAttributes(survey.layout, scene);
  scene.comesAsMeshes = survey.layout.surfaceKind == caches::SurfaceKind::mesh;
  takeBounds(survey.bounds, survey.voxel, scene);
  takeView(survey.bounds, scene.render.camera);
  std::vector<std::string> lines = caches::describe(survey.layout);
  const Vec3d low = survey.bounds.min(), size = survey.bounds.extents();
  lines.push_back(fmt::format("size      {:.3g} x {:.3g} x {:.3g} m, from ({:.3g}, {:.3g}, {:.3g}) on",
                              size[0], size[1], size[2], low[0], low[1], low[2]));
  lines.push_back(
      fmt::format("cells     of {:.4g} m; {:g} frames a second", survey.voxel, scene.sim.frameRate));
  return lines;
}

}  // namespace fluidtex::pipeline
