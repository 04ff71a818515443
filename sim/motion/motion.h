// Where frames come from: the solver, or a flow known in closed form.
#pragma once

#include "sim/motion/analytic_flow.h"
#include "sim/step/solver.h"

#include <optional>
#include <variant>

namespace fluidtex::sim {

using Motion = std::variant<Solver, AnalyticFlow>;

// What `motion` asks for, from the start or on from a state. Throws SolverError when the state was
// made at another resolution.
Motion makeMotion(const Options& options, const MotionOptions& motion, std::optional<State> state = {});

// As Solver::next(), Solver::state() and Solver::warnings().
Frame nextFrame(Motion& motion, const std::function<void(double)>& progress = {});
const State& stateOf(const Motion& motion);
std::vector<std::string> warningsOf(const Motion& motion);
// The same before there is one: nothing is put on a grid but the solids' meshes and ground.
std::vector<std::string> warningsOf(const Options& options, const MotionOptions& motion);

}  // namespace fluidtex::sim
