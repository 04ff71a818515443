// Events between the steps that change the liquid: pouring, and a change of solids or of flows.
#pragma once

#include "sim/flows/flows.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/solids.h"
#include "sim/step/apply_forces.h"
#include "sim/step/liquid.h"

#include <functional>

namespace fluidtex::sim {

// Adds a body of liquid. settle() projects the velocity of the whole.
// surface: the body's signed distance, without the surface where it ends at solids
// (sim/surface/poured_surface.h). values: its velocity, temperature and mixture; shape and time do not count.
void pour(Liquid& liquid, const ShapeDistance& body, const std::function<double(const Vec3d&)>& surface,
          const LiquidBody& values, const SolidField& solid);

// Removes liquid from the places that solids leave when `before` turns into `after`.
void changeSolids(Liquid& liquid, const SolidField& before, const SolidField& after);

// Makes phi a distance and the velocity divergence-free after pouring or a change of solids or of flows.
// Gravity and viscosity act for `kick` seconds. known: as settleSurface() takes it. False when a solve does
// not converge.
[[nodiscard]] bool settle(Liquid& liquid, const SolidField& solid, double kick, const Options& options,
                          StepReport* report = nullptr, const RunningFlows& flows = {},
                          const MaskGrid& known = {});

}  // namespace fluidtex::sim
