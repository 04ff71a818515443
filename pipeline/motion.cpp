#include "pipeline/motion.h"

#include <utility>

namespace fluidtex::pipeline {
namespace {

bool isOutOfFiles(const scenes::Scene& scene) {
  return scene.motion.flow == sim::MotionKind::files;
}

}  // namespace

Motion makeMotion(const scenes::Scene& scene, std::optional<sim::State> state) {
  if (!isOutOfFiles(scene)) return sim::makeMotion(scene.sim, scene.motion, std::move(state));
  if (caches::isRecording(scene.files.path)) {
    caches::Recording recording = caches::openRecording(scene.files.path);
    return state ? caches::RecordedFlow(std::move(recording), *state)
                 : caches::RecordedFlow(std::move(recording));
  }
  caches::Cache cache{scene.files, caches::recognize(scene.files), scene.files.voxel, scene.sim.frameRate};
  return state ? caches::CachedFlow(std::move(cache), std::move(*state))
               : caches::CachedFlow(std::move(cache));
}

sim::Frame nextFrame(Motion& motion, const std::function<void(double)>& progress) {
  if (auto* cached = std::get_if<caches::CachedFlow>(&motion)) return cached->next(progress);
  if (auto* recorded = std::get_if<caches::RecordedFlow>(&motion)) return recorded->next(progress);
  return sim::nextFrame(std::get<sim::Motion>(motion), progress);
}

std::optional<std::filesystem::path> awaitedFile(Motion& motion) {
  auto* cached = std::get_if<caches::CachedFlow>(&motion);
  return cached != nullptr ? cached->awaited() : std::nullopt;
}

const sim::State& stateOf(const Motion& motion) {
  if (const auto* cached = std::get_if<caches::CachedFlow>(&motion)) return cached->state();
  if (const auto* recorded = std::get_if<caches::RecordedFlow>(&motion)) return recorded->state();
  return sim::stateOf(std::get<sim::Motion>(motion));
}

std::optional<caches::CachedMesh> meshOf(const Motion& motion, int frame) {
  const auto* cached = std::get_if<caches::CachedFlow>(&motion);
  if (cached == nullptr || !cached->comesAsMeshes()) return std::nullopt;
  return cached->mesh(frame);
}

std::vector<std::string> warningsOf(const Motion& motion) {
  if (const auto* cached = std::get_if<caches::CachedFlow>(&motion)) return cached->warnings();
  if (std::holds_alternative<caches::RecordedFlow>(motion)) return {};
  return sim::warningsOf(std::get<sim::Motion>(motion));
}

std::vector<std::string> warningsOf(const scenes::Scene& scene) {
  if (isOutOfFiles(scene)) return {};
  return sim::warningsOf(scene.sim, scene.motion);
}

}  // namespace fluidtex::pipeline
