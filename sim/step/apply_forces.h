// The implicit part of a step: viscosity, then pressure, each for all of the liquid.
#pragma once

#include "sim/options.h"
#include "sim/pressure/pressure.h"
#include "sim/solids/solids.h"
#include "sim/step/liquid.h"
#include "sim/viscosity/viscosity.h"

namespace fluidtex::sim {

struct StepReport {
  PressureReport pressure;
  ViscosityReport viscosity;
  bool heatConverged = true;
};

// Viscosity acts for `kick` seconds, as gravity does.
// viscosity: Pa s at cell centres, null for Options::viscosity everywhere. report: its solves are filled in.
// False where a solve does not converge.
bool applyViscosityFor(Liquid& liquid, const SolidField& solid, double kick, const Options& options,
                       const FloatGrid* viscosity, StepReport& report);

struct PressureStep {
  double dt = 0.0;       // s, over which the velocity is projected
  double kick = 0.0;     // s, time for which gravity, viscosity and surface tension act in this step
  bool viscous = false;  // whether viscosity acts, so that walls without free slip hold liquid
  bool driven = false;   // in a regular step; fills liquid.acceleration, and requires liquid.deficit
};

// Projects the velocity, extrapolates it, constrains it at solids and opens gaps where liquid separates from
// them.
// arrived: the velocity before viscosity; without grids, that before the projection takes its place. report:
// may be null. False where the solve does not converge or a velocity is not finite.
bool applyPressure(Liquid& liquid, const SolidField& solid, const PressureStep& step, const Options& options,
                   Velocity arrived, StepReport* report);

}  // namespace fluidtex::sim
