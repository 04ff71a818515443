// Source of frames: the solver, or an analytic flow.
#pragma once

#include "sim/motion/analytic_flow.h"
#include "sim/step/solver.h"

#include <optional>
#include <variant>

namespace fluidtex::sim {

using Motion = std::variant<Solver, AnalyticFlow>;

// The source that `motion` selects, from the start or from a state. Throws SolverError when the state was
// made at another resolution.
Motion makeMotion(const Options& options, const MotionOptions& motion, std::optional<State> state = {});

// As Solver::next(), Solver::state() and Solver::warnings().
Frame nextFrame(Motion& motion, const std::function<void(double)>& progress = {});
const State& stateOf(const Motion& motion);
std::vector<std::string> warningsOf(const Motion& motion);
// The same without making the source: only the solids' meshes and ground are sampled on a grid.
std::vector<std::string> warningsOf(const Options& options, const MotionOptions& motion);

}  // namespace fluidtex::sim
