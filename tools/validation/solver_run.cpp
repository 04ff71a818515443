#include "tools/validation/solver_run.h"

#include "sim/grid/mac_grid.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {

using sim::Coord;
using sim::Vec3d;

sim::Solver startedWith(const sim::Options& options, const std::function<Vec3d(const Vec3d&)>& velocity) {
  sim::Solver first(options);
  first.next();
  sim::State state = first.state();
  for (int axis = 0; axis < 3; ++axis) {
    auto& grid = state.velocity.component[axis];
    grid = grid->deepCopy();
    for (auto it = grid->beginValueOn(); it; ++it)
      it.setValue(static_cast<float>(velocity(grid->indexToWorld(it.getCoord()))[axis]));
  }
  state.leapfrogOffset = 0.0;
  return sim::Solver(options, std::move(state));
}

double surfaceHeight(const sim::State& state, int i, int j, int cells) {
  const auto phi = state.phi->getConstUnsafeAccessor();
  for (int k = cells - 1; k >= 0; --k) {
    const double here = phi.getValue(Coord(i, j, k)), above = phi.getValue(Coord(i, j, k + 1));
    if (here < 0.0)
      return (k + 0.5 + (above >= 0.0 ? here / (here - above) : 0.5)) * state.phi->voxelSize()[0];
  }
  return 0.0;
}

double columnDepth(const sim::State& state, int i, int j, int cells) {
  const auto phi = state.phi->getConstUnsafeAccessor();
  const double h = state.phi->voxelSize()[0];
  double depth = 0.0;
  for (int k = 0; k < cells; ++k) depth += std::clamp(0.5 * h - phi.getValue(Coord(i, j, k)), 0.0, h);
  return depth;
}

}  // namespace fluidtex::validation
