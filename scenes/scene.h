// A scene file, parsed and validated: the settings of every room. Schema: scenes/README.md.
#pragma once

#include "caches/options.h"
#include "render/options.h"
#include "sim/motion_options.h"
#include "sim/options.h"
#include "texture/options.h"
#include "transport/options.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace fluidtex::scenes {

enum class Quality { preview, standard, final };

// Name as on the command line: preview, default, final.
const char* nameOf(Quality quality);

// A mesh with UVs, whose texture the liquid begins with. The exemplar is its picture.
struct Start {
  sim::MeshShape mesh;  // no file: none
  bool renew = true;    // also what is still as it was at the start
  bool fitted = false;  // the exemplar's size and the points' spacing are the mesh's: pipeline::fitToStart()
};

struct Scene {
  std::string name;  // key `name`, or the file's without folder and extension
  std::filesystem::path file;
  int frames = 72;  // how many; numbered from 1
  std::uint64_t seed = 1;
  sim::Options sim;
  sim::MotionOptions motion;
  caches::Options files;  // with MotionKind::files
  // The lowest corner of the domain, metres; other than 0 where it was found in files.
  sim::Vec3d domainOrigin{0.0};
  texture::Options texture;
  // What FactorBy::distance is measured from.
  std::vector<sim::Shape> scaleFrom, renewalFrom;
  std::vector<sim::Shape> keepClear;  // places where the orientation field should have no singularities
  Start start;
  transport::Options transport;
  sim::MeshSequence onto;      // meshes that get the texture too, one a frame; no name: those of `ontoSource`
  bool ontoSource = true;      // that the liquid comes as, where it comes as meshes
  bool comesAsMeshes = false;  // out of files; found by pipeline::takeCache()
  render::Options render;
  std::string resolved;  // the whole scene after quality and overrides, every key with its value, as JSON
};

// Whether other meshes than the textured surface's own get the texture too.
inline bool putsOnto(const Scene& scene) {
  return !scene.onto.files.empty() || (scene.comesAsMeshes && scene.ontoSource);
}

// Whether each frame shows one picture of a sequence, the same at all places.
inline bool showsMovingPicture(const Scene& scene) {
  const texture::AnimationOptions& animation = scene.texture.exemplar.animation;
  return texture::moves(scene.texture) && animation.by == texture::ShowBy::time;
}

// What the command line adds to a scene file.
struct Overrides {
  Quality quality = Quality::standard;
  std::vector<std::string> set;    // "dotted.key=value", value as in TOML, bare words taken as strings
  std::filesystem::path exemplar;  // empty: the scene's own; else toroidal is false unless set
  bool liquidOnly = false;         // no exemplar is asked for, and none is read
};

// Every fault found in the file, one line each:  FILE:LINE:COLUMN: error: KEY: what is wrong; what would be
// right
struct SceneError : std::runtime_error {
  explicit SceneError(std::vector<std::string> faults);
  std::vector<std::string> faults;
};

// Parses, applies [quality.NAME] and the overrides, and validates. Paths inside are relative to the file's
// folder. Throws SceneError with all faults.
Scene loadScene(const std::filesystem::path& file, const Overrides& overrides = {});

// The scene of another program's cache that has no scene file: motion.flow = "files", everything else as the
// overrides say or by default. What is found out from the files is still missing: see pipeline/take_cache.h.
Scene sceneOfCache(const std::filesystem::path& cache, const Overrides& overrides = {});

}  // namespace fluidtex::scenes
