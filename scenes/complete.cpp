#include "scenes/complete.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::scenes {
namespace {

// As many iterations as there are windows: the defaults, the last one repeated.
std::vector<int> fitted(std::vector<int> iterations, std::size_t windows) {
  const int last = iterations.back();
  iterations.resize(windows, last);
  return iterations;
}

// What coherence says of keys that are not given. Half of it leaves their defaults; towards 1 what is kept
// may be stretched more and more (log), less is renewed in a second, and it fades slower; towards 0 all of
// that less. None of it: each frame alone.
void followCoherence(texture::Options& texture, const Reader& reader) {
  constexpr double kMostStretch = 8.0, kLongestFade = 2.0;  // torn; s
  texture::SynthesisOptions& synthesis = texture.synthesis;
  const double coherence = texture.coherence;
  if (coherence == 0.5) return;
  if (coherence == 0.0 && !reader.given("texture.later_frames"))
    texture.laterFrames = texture::LaterFrames::alone;
  const double more = std::max(coherence, 1e-3) / std::max(1.0 - coherence, 1e-3);
  if (!reader.given("texture.keep_stretch"))
    synthesis.keepStretch = std::min(std::pow(synthesis.keepStretch, more), kMostStretch);
  if (!reader.given("texture.renewal_rate")) synthesis.renewalRate /= more;
  if (!reader.given("texture.fade")) synthesis.fade = std::min(synthesis.fade * more, kLongestFade);
}

}  // namespace

void complete(Scene& scene, const Reader& reader) {
  if (scene.name.empty()) scene.name = scene.file.stem().string();
  scene.sim.seed = scene.texture.surface.seed = scene.texture.synthesis.seed = scene.seed;
  scene.texture.synthesis.ways = {scene.texture.orientation.symmetry, scene.texture.orientation.mirrored};
  scene.onto.last = scene.onto.first + scene.frames - 1;

  for (std::size_t i = 0; i < scene.sim.solids.size(); ++i) {
    std::string& name = scene.sim.solids[i].name;
    if (name.empty()) name = "solid " + std::to_string(i);
    auto* sequence = std::get_if<sim::MeshSequence>(&scene.sim.solids[i].shape.kind);
    if (sequence && !reader.given("solid." + std::to_string(i) + ".mesh_sequence.frame_rate"))
      sequence->frameRate = scene.sim.frameRate;
  }

  texture::AnimationOptions& animation = scene.texture.exemplar.animation;
  if (animation.files.empty()) animation.by = texture::ShowBy::time;

  texture::SynthesisOptions& synthesis = scene.texture.synthesis;
  followCoherence(scene.texture, reader);
  if (!reader.given("texture.first_iterations"))
    synthesis.firstIterations = fitted(synthesis.firstIterations, synthesis.windows.size());
  if (!reader.given("texture.later_iterations"))
    synthesis.laterIterations = fitted(synthesis.laterIterations, synthesis.windows.size());

  // What the cache says, where the scene does not: see pipeline/take_cache.h.
  const bool found = scene.motion.flow == sim::MotionKind::files;
  if (found && !reader.given("frames")) scene.frames = 0;
  if (found && !reader.given("domain.size")) {
    scene.sim.size = Vec3d(0.0);
    scene.sim.sides.fill(sim::Side::unbounded);
  }

  // A floor would hide what falls through it, and a rim would bound what has no bounds.
  const auto& sides = scene.sim.sides;
  render::Surroundings& around = scene.render.surroundings;
  if (sides[4] == sim::Side::unbounded && !found && !reader.given("render.ground")) around.ground = false;
  if (std::find(sides.begin(), sides.end(), sim::Side::unbounded) != sides.end() &&
      !reader.given("render.tank"))
    around.tank = false;

  // The default view frames a domain of one metre; it grows with the domain.
  const render::Camera view;
  render::Camera& camera = scene.render.camera;
  const Vec3d& size = scene.sim.size;
  if (found && size[0] == 0.0) {
    if (!reader.given("camera.at")) camera.at = Vec3d(std::numeric_limits<double>::quiet_NaN());
    if (!reader.given("camera.from")) camera.from = Vec3d(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  if (!reader.given("camera.at")) camera.at = view.at * size;
  if (!reader.given("camera.from"))
    camera.from = camera.at + (view.from - view.at) * std::max({size[0], size[1], size[2]});
}

}  // namespace fluidtex::scenes
