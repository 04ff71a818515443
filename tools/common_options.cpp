#include "tools/common_options.h"

#include "caches/layouts/numbered_files.h"
#include "pipeline/start_mesh.h"
#include "pipeline/take_cache.h"
#include "scenes/writer.h"
#include "sim/grid/mac_grid.h"
#include "sim/meshes/read_mesh.h"
#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/pose.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"
#include "texture/exemplar/image.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iostream>
#include <system_error>

namespace fluidtex::tools {
namespace {

int parseNumber(std::string_view text, const std::string& whole) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 1)
    throw UsageError(fmt::format(
        "--frames {}: is no range of frames; write FIRST:LAST, numbered from 1, such as 1:24", whole));
  return number;
}

std::string extentsText(const sim::Vec3d& extents) {
  return fmt::format("{:.3g} x {:.3g} x {:.3g} m", extents.x(), extents.y(), extents.z());
}

// A sentence about a mesh that gets nowhere near the domain, as one in millimetres; empty of others. reach:
// where it would have to be.
std::string farAway(const std::filesystem::path& file, double scale, const sim::TriangleMesh& mesh,
                    const openvdb::BBoxd& reach, const sim::Vec3d& size) {
  openvdb::BBoxd bounds;
  for (const openvdb::Vec3f& x : mesh.positions) bounds.expand(sim::Vec3d(x));
  if (reach.hasOverlap(bounds)) return {};
  std::string hint;
  for (const double factor : {0.001, 0.01, 0.0254, 0.1, 10.0, 100.0, 1000.0}) {
    const openvdb::BBoxd scaled(factor * bounds.min(), factor * bounds.max());
    if (!hint.empty() || !openvdb::BBoxd(sim::Vec3d(0.0), size).isInside(scaled.getCenter()) ||
        scaled.extents().length() < 0.01 * size.length() || scaled.extents().length() > 10.0 * size.length())
      continue;
    hint =
        fmt::format("; with scale = {:g} it would measure {}", factor * scale, extentsText(scaled.extents()));
  }
  return fmt::format(
      "{}: lies outside the domain: it measures {}, from ({:.3g}, {:.3g}, {:.3g}) on, the domain {}{}",
      file.string(), extentsText(bounds.extents()), bounds.min().x(), bounds.min().y(), bounds.min().z(),
      extentsText(size), hint);
}

// Reads every mesh file and forgets it: one that is damaged is known before anything is done. Says which are
// far from the domain.
void tryMeshes(const sim::Shape& shape, const openvdb::BBoxd& reach, const sim::Vec3d& size, bool quiet) {
  const auto tryParts = [&](const std::vector<sim::Shape>& parts) {
    for (const sim::Shape& part : parts) tryMeshes(part, reach, size, quiet);
  };
  const auto warn = [&](const std::string& warning) {
    if (!quiet && !warning.empty()) say("warning: {}\n", warning);
  };
  if (const auto* mesh = std::get_if<sim::MeshShape>(&shape.kind))
    warn(farAway(mesh->file, mesh->place.scale, sim::readMesh(*mesh), reach, size));
  if (const auto* sequence = std::get_if<sim::MeshSequence>(&shape.kind)) sim::MovingMesh{*sequence};
  if (const auto* both = std::get_if<sim::Union>(&shape.kind)) tryParts(both->parts);
  if (const auto* rest = std::get_if<sim::Difference>(&shape.kind)) tryParts(rest->parts);
}

// One byte more than a scene may have.
const std::string& standardInput() {
  static const std::string text = [] {
    std::string read((4 << 20) + 1, '\0');
    std::cin.read(read.data(), std::streamsize(read.size()));
    read.resize(std::size_t(std::cin.gcount()));
    return read;
  }();
  return text;
}

// Whether the file is the one that the scene names, or one of the sequence.
bool isNamed(const std::string& file, const std::string& named) {
  const std::size_t percent = named.find('%'), letter = named.find('d', percent);
  if (file == named || percent == named.npos || letter == named.npos) return file == named;
  const std::string head = named.substr(0, percent), tail = named.substr(letter + 1);
  return file.size() > head.size() + tail.size() && file.starts_with(head) && file.ends_with(tail) &&
         std::all_of(file.begin() + long(head.size()), file.end() - long(tail.size()),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

// The key, dotted, that names the file with which the message begins; empty where there is none.
std::string keyOfFile(const std::string& message, const scenes::Scene& scene) {
  const nlohmann::json keys = nlohmann::json::parse(scene.resolved).flatten();
  for (std::size_t end = message.size(); end != message.npos && end > 0;
       end = message.find_last_of(": ", end - 1)) {
    const std::string file =
        std::filesystem::absolute(message.substr(0, end)).lexically_normal().generic_string();
    for (const auto& [key, value] : keys.items()) {
      if (!value.is_string() || !isNamed(file, value.get<std::string>())) continue;
      std::string dotted = key.substr(1);
      std::replace(dotted.begin(), dotted.end(), '/', '.');
      return dotted;
    }
  }
  return {};
}

// Where a quality was asked for and nothing comes of it.
std::string qualityNote(const CommonOptions& options, const scenes::Scene& scene) {
  if (options.quality == "default") return {};
  scenes::Overrides plain = overridesOf(options);
  plain.quality = scenes::Quality::standard;
  const auto keys = [](const scenes::Scene& of) {
    nlohmann::json resolved = nlohmann::json::parse(of.resolved);
    resolved.erase("quality");
    return resolved;
  };
  if (keys(scenes::loadScene(sourceOf(options), plain)) != keys(scene)) return {};
  return fmt::format(
      "--quality {0}: changes nothing, since {1} sets nothing in a [quality.{0}] table; give --set "
      "texture.points=N, --set domain.resolution=N and --set render.samples=N instead",
      options.quality, scene.file.string());
}

}  // namespace

std::vector<Option> simulationOptions(CommonOptions& options) {
  return {
      {"scene",
       &options.scene,
       "SCENE",
       "Scene file, - for one on stdin, or a folder or file of another program's cache",
       {.required = true}},
      {"--frames", &options.frames, "A:B",
       "First and last frame, numbered from 1, such as 1:24; earlier ones are computed, not written"},
      {"--threads",
       &options.threads,
       "N",
       "How many threads (default: one a core)",
       {.least = 1, .most = 4096}},
      {"--quality",
       &options.quality,
       "NAME",
       "preview, default or final: the scene's own [quality] tables; of a cache 10,000, 40,000 or 200,000 "
       "points",
       {.words = {"preview", "default", "final"}}},
      {"--set", &options.set, "KEY=VALUE", "Sets any key of the scene, dotted; may be repeated"},
      {"--quiet", &options.quiet, "", "No progress, only errors"},
      {"--verbose", &options.verbose, "", "More in the log"},
  };
}

std::vector<Option> sceneOptions(CommonOptions& options) {
  std::vector<Option> all = simulationOptions(options);
  append(all, {{"--out", &options.out, "DIR",
                "Folder for the results (default: out/NAME, that of the scene or the cache)"},
               {"--exemplar", &options.exemplar, "IMAGE",
                "Image to grow the texture from: of a cache, or instead of the scene's"}});
  return all;
}

std::vector<Option> formatOptions(CommonOptions& options) {
  return {
      {"--format",
       &options.formats,
       "NAME",
       "Write surfaces as glb, obj, usda or vtp too, with commas between several; ply is always written",
       {.withCommas = true}},
      {"--joints",
       &options.joints,
       "HOW",
       "In glb and usda, where pieces of texture meet: cut (one set of coordinates, hard joints; default) or "
       "blend (three, for a material that mixes them)",
       {.words = {"cut", "blend"}}},
  };
}

Option exemplarOfRun(std::filesystem::path& exemplar) {
  return {"--exemplar", &exemplar, "IMAGE", "The run's exemplar, where it is no longer at its place"};
}

JointsAs jointsAs(const CommonOptions& options) {
  return options.joints == "blend" ? JointsAs::blend : JointsAs::cut;
}

bool isCache(const std::filesystem::path& scene) {
  if (scene == "-") return false;
  std::error_code unknown;
  return std::filesystem::is_directory(scene, unknown) ||
         (scene.extension() != ".toml" &&
          (std::filesystem::exists(scene, unknown) || caches::isPattern(scene)));
}

scenes::Overrides overridesOf(const CommonOptions& options, bool liquidOnly) {
  scenes::Overrides overrides;
  if (options.quality == "preview") overrides.quality = scenes::Quality::preview;
  if (options.quality == "final") overrides.quality = scenes::Quality::final;
  overrides.set = options.set;
  overrides.exemplar = options.exemplar;
  overrides.liquidOnly = liquidOnly;
  return overrides;
}

scenes::Source sourceOf(const CommonOptions& options) {
  if (options.scene != "-") return {options.scene, {}};
  if (standardInput().empty()) throw UsageError("-: no scene comes on stdin");
  return {"stdin", standardInput()};
}

namespace {

// The mesh is often the liquid's own: its name stands at two keys.
void fitToMesh(const CommonOptions& options, scenes::Scene& scene) {
  try {
    pipeline::fitToStart(scene);
  } catch (const sim::MeshError& error) {
    if (isCache(options.scene)) throw;
    throw scenes::SceneError(
        {scenes::faultLine(sourceOf(options), overridesOf(options), "texture.start.file", error.what())});
  } catch (const texture::ExemplarError&) {
    atItsLine(options, scene, [] { throw; });
  }
}

}  // namespace

scenes::Scene loadScene(const CommonOptions& options) {
  const scenes::Overrides overrides = overridesOf(options);
  const bool ofCache = isCache(options.scene);
  if (std::error_code unknown; !ofCache && options.scene != "-" && options.scene.extension() != ".toml" &&
                               !std::filesystem::exists(options.scene, unknown))
    throw UsageError(
        fmt::format("{}: there is no such scene file, and no such cache", options.scene.string()));
  const auto givesExemplar = [](const std::string& set) { return set.starts_with("texture.exemplar"); };
  if (ofCache && options.exemplar.empty() &&
      std::none_of(options.set.begin(), options.set.end(), givesExemplar))
    throw UsageError(
        fmt::format("{}: what it should be textured with is missing; give a picture, --exemplar IMAGE",
                    options.scene.string()));
  scenes::Scene scene = ofCache ? scenes::sceneOfCache(options.scene, overrides)
                                : scenes::loadScene(sourceOf(options), overrides);
  if (!ofCache && !options.quiet)
    if (const std::string note = qualityNote(options, scene); !note.empty()) say("warning: {}\n", note);
  scene.files.follow = options.follow;
  if (options.follow && scene.motion.flow != sim::MotionKind::files)
    throw UsageError("--follow: the scene's liquid does not come out of files that could be waited for");
  if (scene.motion.flow == sim::MotionKind::files) {
    const std::vector<std::string> found = pipeline::takeCache(scene);
    scene.resolved = scenes::resolvedText(scene, overrides.quality);
    if (ofCache && !options.quiet)
      for (const std::string& line : found) print("{}\n", line);
  }
  const openvdb::BBoxd domain = sim::domainBox(scene.sim);
  fitToMesh(options, scene);
  atItsLine(options, scene, [&] {
    for (const sim::LiquidBody& body : scene.sim.liquid)
      tryMeshes(body.shape, domain, scene.sim.size, options.quiet);
    for (const sim::Solid& solid : scene.sim.solids)
      tryMeshes(solid.shape, sim::reachOf(solid, domain), scene.sim.size, options.quiet);
  });
  return scene;
}

void atItsLine(const CommonOptions& options, const scenes::Scene& scene, const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    const std::string key = isCache(options.scene) ? "" : keyOfFile(error.what(), scene);
    if (key.empty()) throw;
    throw scenes::SceneError({scenes::faultLine(sourceOf(options), overridesOf(options), key, error.what())});
  }
}

void parseFrames(const std::string& text, const scenes::Scene& scene, int& first, int& last) {
  first = 1;
  last = scene.frames;
  if (text.empty()) return;
  const std::size_t colon = text.find(':');
  first = parseNumber(text.substr(0, colon), text);
  if (colon == std::string::npos)
    last = first;
  else if (colon + 1 < text.size())
    last = parseNumber(text.substr(colon + 1), text);
  if (last < first) throw UsageError(fmt::format("--frames {}: ends before it begins", text));
  if (last <= scene.frames) return;
  if (scene.motion.flow == sim::MotionKind::files)
    throw UsageError(fmt::format("--frames {}: the files of {} are of {} frames; give 1:{} at most", text,
                                 scene.files.path.string(), scene.frames, scene.frames));
  throw UsageError(fmt::format("--frames {}: the scene has {} frames; --set frames={} makes more", text,
                               scene.frames, last));
}

}  // namespace fluidtex::tools
