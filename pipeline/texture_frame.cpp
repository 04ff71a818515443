#include "pipeline/texture_frame.h"

#include "pipeline/foreseen_surface.h"
#include "pipeline/liquid_values.h"
#include "pipeline/start_mesh.h"
#include "pipeline/stopwatch.h"
#include "texture/frames/renewal.h"
#include "texture/labels/fresh.h"
#include "texture/mesh/prepare.h"
#include "texture/shown/plain.h"
#include "texture/shown/rest_positions.h"
#include "transport/carry.h"

#include <algorithm>
#include <utility>

namespace fluidtex::pipeline {
namespace {

using texture::Carried;
using texture::LaterFrames;
using texture::Method;
using texture::Surface;
using texture::TexturedSurface;

texture::Seeds seedsFor(const TexturedSurface& last, const sim::Frame& frame,
                        const texture::SurfaceOptions& options) {
  if (options.points == texture::Points::random) return {};
  return {transport::moved(last.positions, frame), last.positions, last.triangles, last.scale};
}

// Whether the surface needs all pyramid levels: on the first frame, and where each frame is textured alone.
bool needsAllLevels(const scenes::Scene& scene, const TexturedSurface& last) {
  const bool eachAlone =
      scene.texture.laterFrames == LaterFrames::alone && scene.texture.synthesis.method != Method::none;
  return last.empty() || eachAlone;
}

// Adds coarser levels where fresh regions are wide, as these are textured coarse to fine.
void addLevelsForFresh(const Texturing& texturing, const sim::Frame& frame, const Carried& carried,
                       const texture::VertexGraph& graph, Surface& surface) {
  const scenes::Scene& scene = texturing.scene;
  const std::vector<int>& windows = scene.texture.synthesis.windows;
  if (!texture::any(texture::wideFresh(graph, texture::freshVertices(carried.trust),
                                       *std::max_element(windows.begin(), windows.end()))))
    return;
  texture::addCoarserLevels(*frame.surfacePhi, scene.texture.surface.levels, scene.texture.surface,
                            factorIn(texturing.scale, frame), surface);
}

// Guidance by age means the surface's age, which renewed texture does not reset.
void keepAge(const Carried& carried, double seconds, TexturedSurface& surface) {
  for (std::size_t v = 0; v < carried.age.size(); ++v)
    surface.age[v] = texture::believed(carried.trust[v]) ? carried.age[v] + float(seconds) : 0.0f;
}

TexturedSurface synthesized(Texturing& texturing, Surface surface, const Carried& carried, int frame,
                            texture::SynthesisStats& stats, const std::function<void(double)>& progress) {
  const scenes::Scene& scene = texturing.scene;
  // Nothing has moved yet where the first frame has a texture that it begins with.
  const double seconds = frame == 1 ? 0.0 : 1.0 / scene.sim.frameRate;
  const bool alone = scene.texture.laterFrames == LaterFrames::alone && !carried.empty();
  const Carried nothing;
  TexturedSurface result = texture::synthesize(texturing.synthesizer, std::move(surface),
                                               alone ? nothing : carried, frame, seconds, stats, progress);
  if (alone) {
    result.trust = carried.trust;
    result.previousPosition = carried.previousPosition;
  }
  if (scene.texture.guidance.by == texture::GuidanceBy::age) keepAge(carried, seconds, result);
  return result;
}

// The wear of transported texture counts by the scene's factors; what is original may never be renewed. In
// the first frame startOn() has locked all that a mesh gave.
void scaleWear(const Texturing& texturing, const sim::Frame& frame, const texture::SurfaceMesh& mesh,
               Carried& carried) {
  if (carried.empty() || !carried.renewal.empty()) return;
  if (const texture::PointScale factor = factorIn(texturing.renewal, frame))
    carried.renewal = factor(mesh.positions);
  if (texturing.scene.start.renew || carried.original.empty()) return;
  if (carried.renewal.empty()) carried.renewal.assign(carried.original.size(), 1.0f);
  for (std::size_t v = 0; v < carried.original.size(); ++v)
    if (carried.original[v]) carried.renewal[v] = 0.0f;
}

// Where the exemplar's guidance is what a mesh shows of it, new texture comes from there.
void takeFromShown(const Texturing& texturing, Surface& surface) {
  if (!beginsWithMesh(texturing.scene) || texturing.guidance.options.by != texture::GuidanceBy::none ||
      !texturing.synthesizer.exemplar.guided)
    return;
  for (texture::SurfaceMesh& mesh : surface.levels) mesh.guidance.assign(mesh.positions.size(), 1.0f);
}

// Textures by the scene's method; velocity and contact are left to the caller.
TexturedSurface textured(Texturing& texturing, Surface surface, const Carried& carried, int frame,
                         texture::SynthesisStats& stats, const std::function<void(double)>& progress) {
  const scenes::Scene& scene = texturing.scene;
  const bool none = scene.texture.synthesis.method == Method::none;
  if (texture::isProjected(scene.texture)) {
    stats = {};
    stats.renewed = 0.0;
    const texture::Exemplar& exemplar = texturing.synthesizer.exemplar;
    const int every = scene.texture.laterFrames == LaterFrames::dualRest ? scene.texture.restFrames : 0;
    return texture::restTextured(std::move(surface), carried, exemplar.color, {exemplar.toroidal, every},
                                 frame, 1.0 / scene.sim.frameRate);
  }
  if (!none && (scene.texture.laterFrames != LaterFrames::advect || carried.empty()))
    return synthesized(texturing, std::move(surface), carried, frame, stats, progress);
  stats = {};
  stats.renewed = 0.0;
  if (none) return texture::untextured(std::move(surface), carried);
  TexturedSurface result = texture::advected(std::move(surface), carried, 1.0 / scene.sim.frameRate);
  result.exemplarWidth = texturing.synthesizer.exemplar.color.width;
  result.exemplarHeight = texturing.synthesizer.exemplar.color.height;
  return result;
}

// start: startSurface() on the exemplar.
Texturing assembled(const scenes::Scene& scene, texture::Exemplar exemplar, TexturedSurface start,
                    const texture::CacheFolder& cache) {
  return {scene,
          texture::makeSynthesizer(std::move(exemplar), scene.texture.synthesis, cache),
          orientationGuide(scene),
          textureScale(scene),
          textureRenewal(scene),
          std::move(start),
          textureGuidance(scene),
          texture::moves(scene.texture)
              ? Animation(scene.texture.exemplar.animation, scene.texture.exemplar.toroidal)
              : Animation()};
}

}  // namespace

Texturing makeTexturing(const scenes::Scene& scene, const texture::CacheFolder& cache) {
  scenes::Scene fitted = scene;
  fitToStart(fitted);
  const texture::ExemplarOptions& options = fitted.texture.exemplar;
  TexturedSurface start;
  texture::Image shown;
  if (!fitted.start.mesh.file.empty()) {
    const texture::Image picture = texture::exemplarPicture(options);
    start = startSurface(fitted, picture.width, picture.height);
    if (beginsWithMesh(fitted) && options.guidance.empty())
      shown = shownByStart(start, picture.width, picture.height, options.toroidal);
  }
  texture::Exemplar exemplar = texture::loadExemplar(options, fitted.texture.synthesis,
                                                     fitted.texture.surface.levels, cache, std::move(shown));
  return assembled(fitted, std::move(exemplar), std::move(start), cache);
}

Texturing makeTexturing(const scenes::Scene& scene, texture::Exemplar exemplar,
                        const texture::CacheFolder& cache) {
  TexturedSurface start = startSurface(scene, exemplar.color.width, exemplar.color.height);
  scenes::Scene fitted = scene;
  if (!start.empty() && !(scene.texture.spacing > 0.0)) fitted.texture.spacing = start.spacing;
  return assembled(fitted, std::move(exemplar), std::move(start), cache);
}

TexturedFrame textureFrame(Texturing& texturing, const TexturedSurface& last, const sim::Frame& frame,
                           const Watch& watch) {
  const scenes::Scene& scene = texturing.scene;
  const texture::SurfaceOptions& surfaceOptions = scene.texture.surface;
  const int symmetry = texturing.orientation.options.symmetry;
  const auto begin = [&](Stage stage) {
    if (watch.progress) watch.progress(stage, 0.0);
  };
  TexturedFrame result;
  FrameSeconds& seconds = result.seconds;
  double spacing = last.spacing > 0.0 ? last.spacing : scene.texture.spacing;
  Surface surface;
  {
    begin(Stage::prepare);
    const Stopwatch stage(seconds.prepare, watch.seconds);
    // What is followed is known where there is liquid.
    const bool liquid = frame.surfacePhi->tree().leafCount() > 0;
    const texture::PointScale scale = liquid ? factorIn(texturing.scale, frame) : texture::PointScale{};
    if (!(spacing > 0.0)) {
      const double here = texture::spacingForPoints(*frame.surfacePhi, scene.texture.points, scale);
      spacing = here > 0.0 ? std::max(here, foreseenSpacing(scene)) : 0.0;
      result.foreseenSpacing = spacing > here;
    }
    if (spacing > 0.0)
      surface = texture::prepareSurface(*frame.surfacePhi, spacing, seedsFor(last, frame, surfaceOptions),
                                        needsAllLevels(scene, last) ? surfaceOptions.levels : 1,
                                        surfaceOptions, scale);
  }
  if (surface.empty()) {
    result.surface.spacing = spacing;
    return result;
  }
  Carried carried;
  const bool starts = frame.index == 1 && beginsWithMesh(scene);
  {
    begin(Stage::transport);
    const Stopwatch stage(seconds.transport, watch.seconds);
    if (starts)
      carried = startOn(texturing.start, surface.levels[0], frame.surfacePhi->voxelSize().x(), symmetry);
    else
      carried = transport::carry(last, frame, surface.levels[0], symmetry, scene.transport);
  }
  {
    const Stopwatch stage(seconds.prepare, watch.seconds);
    const std::vector<int>& windows = scene.texture.synthesis.windows;
    const texture::VertexGraph graph = texture::buildVertexGraph(surface.levels[0]);
    addLevelsForFresh(texturing, frame, carried, graph, surface);
    texture::orient(surface, carried, {.symmetry = symmetry, .seed = scene.seed},
                    wishesFor(texturing.orientation, frame));
    result.singularities = texture::singularities(surface.levels[0], symmetry);
    texture::calmDroplets(surface.levels[0],
                          texture::droplets(graph, *std::min_element(windows.begin(), windows.end())),
                          scene.texture.synthesis.ways, carried);
    guide(texturing.guidance, frame, carried, 1.0 / scene.sim.frameRate, surface);
    takeFromShown(texturing, surface);
    scaleWear(texturing, frame, surface.levels[0], carried);
  }
  {
    begin(Stage::synthesize);
    const Stopwatch stage(seconds.synthesize, watch.seconds);
    std::function<void(double)> progress;
    if (watch.progress) progress = [&](double part) { watch.progress(Stage::synthesize, part); };
    const std::vector<float> levels =
        texturing.animation.byGuidance() ? surface.levels[0].guidance : std::vector<float>{};
    result.surface =
        textured(texturing, std::move(surface), carried, frame.index, result.synthesis, progress);
    texturing.animation.show(frame.time, levels, result.surface);
  }
  {
    const Stopwatch stage(seconds.transport, watch.seconds);
    result.surface.velocity = transport::velocityAt(result.surface.positions, frame);
    result.surface.contact = transport::contactAt(result.surface.positions, frame);
    addLiquidValues(frame, result.surface);
  }
  return result;
}

}  // namespace fluidtex::pipeline
