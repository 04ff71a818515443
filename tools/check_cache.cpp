#include "tools/check_cache.h"

#include "caches/layouts/layout.h"
#include "caches/liquid/explained.h"
#include "caches/liquid/read_frame.h"
#include "caches/recorded/recording.h"
#include "pipeline/take_cache.h"
#include "sim/grid/mac_grid.h"
#include "tools/base/console.h"
#include "tools/common_options.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace fluidtex::tools {
namespace {

// Pairs of frames that are looked at.
constexpr int kPairs = 5;
// Factors on velocities that are worth a word.
constexpr double kWrongBelow = 0.75, kWrongAbove = 1.33;

// Where the distance left is smallest, as far as it is telling: less than half of that at rest.
bool isTelling(const caches::VelocityFactor& factor) {
  return factor.residual < 0.5 * factor.residualAtRest && factor.residual < 0.8 * factor.residualAsIs &&
         (factor.factor < kWrongBelow || factor.factor > kWrongAbove);
}

}  // namespace

void checkMotionOf(const scenes::Scene& scene, int first, int last) {
  if (caches::isRecording(scene.files.path)) return;
  const caches::Cache cache{scene.files, caches::recognize(scene.files), scene.files.voxel,
                            scene.sim.frameRate};
  if (cache.layout.velocityKind == caches::VelocityKind::none) {
    say("warning: no velocities were found; texture cannot follow the liquid without them\n");
    return;
  }
  std::set<int> begins;
  for (int n = 0; n < kPairs && last > first; ++n)
    begins.insert(first + (last - 1 - first) * n / (kPairs - 1));
  std::vector<double> factors;
  for (const int frame : begins) {
    const int number = cache.layout.first + frame - 1;
    const caches::LiquidFrame begin = caches::readFrame(cache, number),
                              end = caches::readFrame(cache, number + 1);
    if (!begin.velocity || !end.velocity || begin.surface.triangles.empty()) {
      print("motion    {} to {}: no surface, or no velocity\n", number, number + 1);
      continue;
    }
    const double seconds = 1.0 / scene.sim.frameRate;
    const caches::FrameMotion motion =
        caches::bestMotion(*begin.phi, *end.phi, begin.velocity, end.velocity, seconds);
    const std::optional<caches::VelocityFactor> factor =
        caches::bestFactor(*begin.phi, *end.phi, begin.velocity, end.velocity, motion.meanWeight, seconds);
    print("motion    {} to {}: speeds up to {:.3g} m/s; ", number, number + 1, sim::maxAbs(begin.velocity));
    if (!motion.explained || !factor) {
      print("the surface moves too little to tell more\n");
      continue;
    }
    print("the surface moves {:.2g} cells; velocities explain {:.0f}% of it, {:.2g} cells are left\n",
          factor->residualAtRest, 100.0 * *motion.explained, factor->residualAsIs);
    if (isTelling(*factor)) factors.push_back(factor->factor);
  }
  if (2 * factors.size() <= begins.size()) return;
  std::sort(factors.begin(), factors.end());
  say("warning: surface and velocities would fit with velocities {:.3g} times as fast; "
      "files.velocity_scale={:.3g} "
      "makes them so\n",
      factors[factors.size() / 2], factors[factors.size() / 2] * scene.files.velocityScale);
}

void checkCache(const CommonOptions& options) {
  scenes::Overrides overrides;
  overrides.set = options.set;
  overrides.liquidOnly = true;
  scenes::Scene scene = scenes::sceneOfCache(options.scene, overrides);
  const std::vector<std::string> found = pipeline::takeCache(scene);
  int first = 1, last = 0;
  parseFrames(options.frames, scene.frames, first, last);
  if (options.quiet) return;
  for (const std::string& line : found) print("{}\n", line);
  checkMotionOf(scene, first, last);
}

}  // namespace fluidtex::tools
