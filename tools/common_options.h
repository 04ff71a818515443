// Handling of the options that subcommands share.
#pragma once

#include "scenes/scene.h"
#include "scenes/source.h"
#include "tools/commands.h"
#include "tools/formats/export_mesh.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fluidtex::tools {

std::vector<Option> sceneOptions(CommonOptions& options);
// Those that a simulation alone has a use for: no --out, no --exemplar.
std::vector<Option> simulationOptions(CommonOptions& options);
// --format and --joints.
std::vector<Option> formatOptions(CommonOptions& options);
// --exemplar of what is made of a finished run.
Option exemplarOfRun(std::filesystem::path& exemplar);

JointsAs jointsAs(const CommonOptions& options);

// The scene file, or for "-" what comes on stdin, which is read once. Throws UsageError where nothing comes.
scenes::Source sourceOf(const CommonOptions& options);

// Whether this is the cache of another program and no scene file: a folder, a pattern, or a file that does
// not end in .toml.
bool isCache(const std::filesystem::path& scene);

// What --quality, --set and --exemplar say. liquidOnly: no exemplar is asked for.
scenes::Overrides overridesOf(const CommonOptions& options, bool liquidOnly = false);

// Loads the scene with quality, --set and --exemplar applied, and test-reads its mesh files; of a cache, or
// where the scene's liquid comes out of files, what is found in these is filled in. Throws
// scenes::SceneError, sim::MeshError, caches::LayoutError, caches::FormatError.
scenes::Scene loadScene(const CommonOptions& options);

// Does the work. What it finds wrong with a file that the scene names is thrown on as a scenes::SceneError
// with the line that names it.
void atItsLine(const CommonOptions& options, const scenes::Scene& scene, const std::function<void()>& work);

// Parses "A:B", "A:" or "A" into first and last frame of the scene; empty means all. Throws UsageError.
void parseFrames(const std::string& text, const scenes::Scene& scene, int& first, int& last);

}  // namespace fluidtex::tools
