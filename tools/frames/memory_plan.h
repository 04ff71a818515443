// Estimate of a scene's memory.
#pragma once

#include "pipeline/liquid_plan.h"
#include "scenes/scene.h"
#include "tools/formats/export_mesh.h"
#include "tools/formats/format.h"

#include <optional>
#include <vector>

namespace fluidtex::tools {

// Bytes per cell of liquid.
inline constexpr double kBytesPerLiquidCell = 5000.0;

// Points on the surface of all liquid of the scene; nothing if sources bring an unknown amount.
std::optional<double> plannedPoints(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid);

// Bytes, without what flows in from sources; with this many points, none where that is unknown. formats,
// joints: what frames are written as.
double plannedMemory(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid,
                     const std::optional<double>& points, const std::vector<Format>& formats,
                     JointsAs joints);

}  // namespace fluidtex::tools
