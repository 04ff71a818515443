// How much memory a scene takes, as far as it can be told beforehand.
#pragma once

#include "pipeline/liquid_plan.h"
#include "scenes/scene.h"

#include <optional>

namespace fluidtex::tools {

// What a cell of liquid takes, bytes.
inline constexpr double kBytesPerLiquidCell = 5000.0;

// Points on the surface of all liquid of the scene; nothing where sources bring more of it than can be told.
std::optional<double> plannedPoints(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid);

// Bytes, without what flows in from sources.
double plannedMemory(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid);

}  // namespace fluidtex::tools
