#include "caches/liquid/substeps.h"

#include "caches/liquid/explained.h"
#include "caches/liquid/velocity_grids.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

constexpr int kMostSubsteps = 4;

}  // namespace

std::vector<sim::Substep> substepsOf(const sim::FaceGrids& begin, const sim::FaceGrids& end,
                                     double meanWeight, double seconds) {
  std::vector<sim::Substep> substeps;
  const auto add = [&](double dt, const sim::FaceGrids& grids) {
    substeps.push_back({dt, grids.component[0], grids.component[1], grids.component[2]});
  };
  if (meanWeight == 0.0 || meanWeight == 1.0) {
    add(seconds, meanWeight == 0.0 ? begin : end);
  } else if (!sameTransforms(begin, end)) {
    add((1.0 - meanWeight) * seconds, begin);
    add(meanWeight * seconds, end);
  } else {
    const double speed = std::max(sim::maxAbs(begin), sim::maxAbs(end));
    const double cells = speed * seconds / begin[0].voxelSize()[0];
    const int count = int(std::clamp(std::ceil(0.5 * cells), 1.0, double(kMostSubsteps)));
    for (int n = 0; n < count; ++n)
      add(seconds / count, blended(begin, end, weightAt(meanWeight, (n + 0.5) / count)));
  }
  return substeps;
}

}  // namespace fluidtex::caches
