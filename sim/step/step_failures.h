// Error messages of steps that fail.
#pragma once

#include "sim/step/step.h"

namespace fluidtex::sim {

// Substeps shorter than this share of a frame count as a failure.
inline constexpr double kShortest = 1e-5;

// Each throws SolverError with one sentence: what happened at that time, s, and what may help.
// The capillary limit asks for too short steps.
[[noreturn]] void failCapillary(double time);
// The liquid or a solid is too fast. liquid, solids: their speeds, m/s.
[[noreturn]] void failFast(double time, double liquid, double solids);
// A solve did not converge, or a velocity is not finite, in a step of dt seconds.
[[noreturn]] void fail(double time, double dt, const StepReport& report);

}  // namespace fluidtex::sim
