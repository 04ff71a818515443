// The source of a scene's frames: solver, analytic flow, the cache of another program, or recorded frames.
#pragma once

#include "caches/liquid/cached_flow.h"
#include "caches/recorded/recording.h"
#include "scenes/scene.h"
#include "sim/motion/motion.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fluidtex::pipeline {

using Motion = std::variant<sim::Motion, caches::CachedFlow, caches::RecordedFlow>;

// From the start or from a state. Throws as sim::makeMotion(), caches::CachedFlow and
// caches::openRecording().
Motion makeMotion(const scenes::Scene& scene, std::optional<sim::State> state = {});

// The next frame; its number and time are those after the state's. Throws as the source does.
sim::Frame nextFrame(Motion& motion, const std::function<void(double)>& progress = {});
// A file of the next frame that is waited for, as another program still writes it; see
// caches::Options::follow.
std::optional<std::filesystem::path> awaitedFile(Motion& motion);
const sim::State& stateOf(const Motion& motion);
// The mesh that a frame of a cache came as; nothing where it did not come as one.
std::optional<caches::CachedMesh> meshOf(const Motion& motion, int frame);
std::vector<std::string> warningsOf(const Motion& motion);
// Those that are known without making the source.
std::vector<std::string> warningsOf(const scenes::Scene& scene);

}  // namespace fluidtex::pipeline
