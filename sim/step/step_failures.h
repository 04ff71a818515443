// What is said where no step leads on.
#pragma once

#include "sim/step/step.h"

namespace fluidtex::sim {

// Substeps shorter than this share of a frame lead nowhere.
inline constexpr double kShortest = 1e-5;

// Each throws SolverError with one sentence: what happened at that time, s, and what may help.
// Ripples of surface tension ask for too short steps.
[[noreturn]] void failRippling(double time);
// The liquid or a solid is too fast; their speeds, m/s.
[[noreturn]] void failFast(double time, double liquid, double solids);
// A solve did not converge, or a velocity is not finite, in a step of dt seconds.
[[noreturn]] void fail(double time, double dt, const StepReport& report);

}  // namespace fluidtex::sim
