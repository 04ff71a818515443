// Motion out of a cache: frames as the solver gives them.
#pragma once

#include "caches/liquid/cache.h"
#include "caches/liquid/explained.h"
#include "caches/liquid/read_frame.h"
#include "sim/frame/frame.h"
#include "sim/step/liquid.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::caches {

// A frame moves by the velocities of its begin and end, mixed so that they carry the last surface as near to
// this one as they can (bestMotion()); FrameStats::explained says how near. One substep where one of the two
// alone does best, else up to four with the velocities of their middles. Where the grids of the two lie
// differently, the first half is that of the begin.
class CachedFlow {
 public:
  explicit CachedFlow(Cache cache);
  // Continues after the frame of a state; reads its files again.
  CachedFlow(Cache cache, sim::State state);

  // Throws LayoutError, FormatError, and LayoutError too where the velocities of three frames and more
  // explain less than Options::leastExplained of their motion: it says by which factor they would.
  sim::Frame next(const std::function<void(double)>& progress = {});

  // With Options::follow: a file of the next frame that is still to come, see awaitedFile().
  std::optional<std::filesystem::path> awaited();

  bool comesAsMeshes() const { return m_cache.layout.surfaceKind == SurfaceKind::mesh; }
  // The mesh that a frame came as, where they come as meshes. Throws as readSurface().
  CachedMesh mesh(int frame) const { return readMesh(m_cache, numberOf(frame)); }

  // Its grids are empty.
  const sim::State& state() const { return m_state; }
  // So far.
  const std::vector<std::string>& warnings() const { return m_warnings; }

 private:
  int numberOf(int frame) const { return m_cache.layout.first + frame - 1; }
  void addSubsteps(const LiquidFrame& now, sim::Frame& frame);
  void judge(const LiquidFrame& now, const FrameMotion& motion, int number);
  void warnOnce(const std::string& warning);

  Cache m_cache;
  sim::State m_state;
  std::optional<LiquidFrame> m_last;
  std::vector<double> m_explained;  // of the frames since the start that moved
  std::vector<std::string> m_warnings;
};

}  // namespace fluidtex::caches
