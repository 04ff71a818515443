// One substep of the liquid.
#pragma once

#include "sim/flows/flows.h"
#include "sim/solids/solids.h"
#include "sim/step/apply_forces.h"
#include "sim/step/liquid.h"

#include <optional>

namespace fluidtex::sim {

// Capillary limit: the longest step in which the shortest capillary wave of the grid cannot grow, s; infinite
// without surface tension.
// Source: Brackbill, Kothe, Zemach, "A continuum method for modeling surface tension", 1992, eq. 61, with no
// liquid on the other side.
double capillaryStep(const Options& options);

struct TimeStep {
  const SolidField& before;  // the solids until the end of the step
  const SolidField& solid;   // at its end
  double dt = 0.0;           // s
  double nextDt = 0.0;       // s, of the step after
};

// The liquid dt seconds later. Empty when a solve does not converge or a velocity is not finite: try a
// smaller dt. `report`, where given, is filled either way.
// The velocity moves phi, so it should be that of the middle of the step (leapfrog, second order in time).
// Gravity advances the new one to the middle of the step after, of nextDt seconds.
// flows: at the end of the step.
// The markers and the acceleration of `liquid` are moved out of it, also where the step fails (they are too
// large to copy). Give it new markers before another try, which is first-order in time.
// Throws std::invalid_argument where dt is not positive or nextDt is negative.
std::optional<Liquid> step(Liquid& liquid, const TimeStep& times, const Options& options,
                           StepReport* report = nullptr, const RunningFlows& flows = {});

}  // namespace fluidtex::sim
