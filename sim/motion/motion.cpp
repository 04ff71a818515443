#include "sim/motion/motion.h"

#include "sim/flows/flows.h"
#include "sim/solids/solids.h"

#include <utility>

namespace fluidtex::sim {

Motion makeMotion(const Options& options, const MotionOptions& motion, std::optional<State> state) {
  if (motion.flow == MotionKind::solver)
    return state ? Motion(Solver(options, std::move(*state))) : Motion(Solver(options));
  return state ? AnalyticFlow(options, motion, std::move(*state)) : AnalyticFlow(options, motion);
}

Frame nextFrame(Motion& motion, const std::function<void(double)>& progress) {
  return std::visit([&](auto& source) { return source.next(progress); }, motion);
}

const State& stateOf(const Motion& motion) {
  return std::visit([](const auto& source) -> const State& { return source.state(); }, motion);
}

std::vector<std::string> warningsOf(const Motion& motion) {
  const auto* solver = std::get_if<Solver>(&motion);
  return solver != nullptr ? solver->warnings() : std::vector<std::string>{};
}

std::vector<std::string> warningsOf(const Options& options, const MotionOptions& motion) {
  if (motion.flow != MotionKind::solver) return {};
  const Solids solids(options);
  std::vector<std::string> warnings = solids.warnings();
  for (std::string& warning : flowWarnings(options, solids)) warnings.push_back(std::move(warning));
  return warnings;
}

}  // namespace fluidtex::sim
