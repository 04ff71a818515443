#include "caches/liquid/cached_flow.h"

#include "caches/layouts/follow.h"
#include "caches/liquid/fitted_velocity.h"
#include "caches/liquid/read_frame.h"
#include "caches/liquid/substeps.h"
#include "caches/liquid/velocity_grids.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::caches {
namespace {

// Frames of which the velocities must explain too little before a run ends.
constexpr std::size_t kJudged = 3;

std::int64_t cellsInside(const openvdb::FloatGrid& phi) {
  std::int64_t count = 0;
  for (auto leaf = phi.tree().cbeginLeaf(); leaf; ++leaf) {
    const float* values = leaf->buffer().data();
    count += std::count_if(values, values + leaf->size(), [](float value) { return value < 0.0f; });
  }
  auto tile = phi.cbeginValueAll();
  tile.setMaxDepth(openvdb::FloatTree::DEPTH - 2);
  for (; tile; ++tile)
    if (*tile < 0.0f) count += std::int64_t(tile.getVoxelCount());
  return count;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

CachedFlow::CachedFlow(Cache cache) : m_cache(std::move(cache)) {
  const bool none = m_cache.layout.velocityKind == VelocityKind::none;
  if (none && !m_cache.options.fit && m_cache.options.leastExplained > 0.0)
    throw LayoutError(
        m_cache.layout.surface.pattern.string() +
        ": no velocities were found, without which texture cannot follow the liquid; write them "
        "(an attribute v, a grid vel), name them with files.velocity or files.velocity_name, or "
        "let the motion be fitted to the surfaces alone with files.fit=true");
  if (none && m_cache.options.fit)
    warnOnce(m_cache.layout.surface.pattern.string() +
             ": there are no velocities; motion is fitted to the surfaces, which do not show how the liquid "
             "moves along them, so texture there slips");
  m_state.phi = sim::makePhi(m_cache.voxel, float(m_cache.voxel));
  m_state.velocity = sim::makeVelocity(m_cache.voxel);
}

CachedFlow::CachedFlow(Cache cache, sim::State state) : CachedFlow(std::move(cache)) {
  m_state.frame = state.frame;
  m_state.time = state.time;
  if (m_state.frame > 0) m_last = readFrame(m_cache, numberOf(m_state.frame));
}

std::optional<std::filesystem::path> CachedFlow::awaited() {
  if (!m_cache.options.follow) return std::nullopt;
  return awaitedFile(m_cache.layout, numberOf(m_state.frame + 1));
}

void CachedFlow::warnOnce(const std::string& warning) {
  if (std::find(m_warnings.begin(), m_warnings.end(), warning) == m_warnings.end())
    m_warnings.push_back(warning);
}

void CachedFlow::judge(const LiquidFrame& now, const FrameMotion& motion, int number) {
  if (!motion.explained) return;
  m_explained.push_back(*motion.explained);
  if (m_explained.size() < kJudged || median(m_explained) >= m_cache.options.leastExplained) return;
  const double seconds = 1.0 / m_cache.frameRate;
  const std::optional<VelocityFactor> factor =
      bestFactor(*m_last->phi, *now.phi, m_last->velocity, now.velocity, motion.meanWeight, seconds);
  std::string advice = "check that surface and velocities are of the same frames";
  if (factor && factor->residual < 0.5 * factor->residualAtRest)
    advice = fmt::format("with files.velocity_scale={:.3g} they would explain it",
                         factor->factor * m_cache.options.velocityScale);
  const double explained = median(m_explained);
  throw LayoutError(
      fmt::format("{}: up to frame {} the velocities explain {} of the surface's motion "
                  "(files.least_explained is {:.0f}%); "
                  "{}, or go on with files.least_explained=0",
                  m_cache.layout.surface.pattern.string(), number,
                  explained > 0.0 ? fmt::format("only {:.0f}%", 100.0 * explained) : "nothing",
                  100.0 * m_cache.options.leastExplained, advice));
}

void CachedFlow::addSubsteps(const LiquidFrame& now, sim::Frame& frame) {
  const double seconds = 1.0 / m_cache.frameRate;
  const sim::FaceGrids begin = m_last->velocity ? m_last->velocity : sim::makeVelocity(m_cache.voxel);
  const sim::FaceGrids end = now.velocity ? now.velocity : sim::makeVelocity(m_cache.voxel);
  FrameMotion motion;
  if (m_cache.layout.velocityKind == VelocityKind::none && m_cache.options.fit) {
    const sim::FaceGrids fitted = fittedVelocity(*m_last->phi, *now.phi, seconds);
    frame.substeps = substepsOf(fitted, fitted, 0.0, seconds);
    frame.stats.dtMin = seconds;
    return;
  }
  if (m_last->velocity && now.velocity) {
    motion = bestMotion(*m_last->phi, *now.phi, begin, end, seconds);
    judge(now, motion, numberOf(frame.index));
    frame.stats.explained = motion.explained;
  } else {
    motion.meanWeight = m_last->velocity ? 0.0 : 1.0;
  }
  frame.substeps = substepsOf(begin, end, motion.meanWeight, seconds);
  frame.stats.dtMin = frame.substeps.front().dt;
  for (const sim::Substep& substep : frame.substeps)
    frame.stats.dtMin = std::min(frame.stats.dtMin, substep.dt);
}

sim::Frame CachedFlow::next(const std::function<void(double)>& progress) {
  sim::Frame frame;
  frame.index = m_state.frame + 1;
  frame.time = m_state.frame / m_cache.frameRate;
  const int number = numberOf(frame.index);
  LiquidFrame now = readFrame(m_cache, number);
  if (progress) progress(0.7);
  if (now.isSheet)
    warnOnce(m_cache.layout.surface.pattern.string() +
             ": encloses no volume in some frames; surfaces that are open, or smaller than a cell "
             "(files.voxel), are taken as sheets one and a half cells thick");
  if (m_cache.layout.velocityKind == VelocityKind::grids && !now.surface.triangles.empty() &&
      isUnknown(now.velocity))
    warnOnce(
        m_cache.layout.velocity.pattern.string() +
        ": has no active voxels in some frames, in which the liquid is taken to rest; if it moves, write "
        "velocities wherever there is liquid");
  if (m_last) addSubsteps(now, frame);
  frame.surfacePhi = now.phi;
  frame.fields = now.fields;
  frame.stats.cells = cellsInside(*now.phi);
  frame.stats.volume = double(frame.stats.cells) * std::pow(m_cache.voxel, 3);
  now.surface = {};  // the next frame asks for grids only
  m_last = std::move(now);
  m_state.frame = frame.index;
  m_state.time = frame.time;
  if (progress) progress(1.0);
  return frame;
}

}  // namespace fluidtex::caches
