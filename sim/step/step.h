// One substep of the liquid, and the two other ways in which a state comes about: pouring, and a change of
// solids.
#pragma once

#include "sim/flows/flows.h"
#include "sim/grid/mac_grid.h"
#include "sim/pressure/pressure.h"
#include "sim/solids/solids.h"
#include "sim/step/liquid.h"
#include "sim/viscosity/viscosity.h"

#include <functional>
#include <optional>

namespace fluidtex::sim {

// The longest step in which the shortest wave of surface tension that the grid holds cannot grow, s; infinite
// without surface tension. Brackbill, Kothe, Zemach, "A continuum method for modeling surface tension", 1992,
// eq. 61, with no liquid on the other side.
double capillaryStep(const Options& options);

struct StepReport {
  PressureReport pressure;
  ViscosityReport viscosity;
  bool heatConverged = true;
};

// The liquid dt seconds later; the markers and the acceleration of `liquid` are used up, also where nothing
// comes of it (they are too much to keep twice): give it other markers before another try, which is of first
// order in time. `solid` and `flows` are those of that time, `before` is the solid until then. The velocity
// moves phi, so it should be that of the middle of the step (leapfrog, second order in time): gravity takes
// the new one to the middle of the step after, of nextDt seconds. Nothing when a solve does not converge or a
// velocity is not finite: try a smaller dt. `report`, where given, is filled either way.
std::optional<Liquid> step(Liquid& liquid, const SolidField& before, const SolidField& solid, double dt,
                           double nextDt, const Options& options, StepReport* report = nullptr,
                           const RunningFlows& flows = {});

// Adds a body of liquid of that velocity and temperature. The velocity of the whole is projected by settle().
// surface: the body's distance, but for where it ends at solids (sim/surface/poured_surface.h).
void pour(Liquid& liquid, const ShapeDistance& body, const std::function<double(const Vec3d&)>& surface,
          const Vec3d& velocity, double temperature, const SolidField& solid);

// Empties the places that solids leave when `before` turns into `after`.
void changeSolids(Liquid& liquid, const SolidField& before, const SolidField& after);

// Makes phi a distance and the velocity free of divergence after pouring or a change of solids or of flows.
// Gravity and friction act for `kick` seconds. False when a solve does not converge.
[[nodiscard]] bool settle(Liquid& liquid, const SolidField& solid, double kick, const Options& options,
                          StepReport* report = nullptr, const RunningFlows& flows = {});

}  // namespace fluidtex::sim
