#include "tools/frames/memory_plan.h"

namespace fluidtex::tools {
namespace {

// Near the dam break's measured peaks: 0.28 GB at 8,000 points, 0.57 GB at 58,000. What a cell takes is
// mostly the velocities of a frame's substeps, a dozen at a CFL number of 1. Leads, not promises.
constexpr double kBytesPerPoint = 1000.0;
constexpr double kBytesProgram = 250e6;
// Three floats, three bytes, and those again packed.
constexpr double kBytesPerPixel = 18.0;

}  // namespace

std::optional<double> plannedPoints(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid) {
  const double spacing = scene.texture.spacing, h = scene.sim.voxelSize();
  if (spacing <= 0.0) return scene.texture.points;
  if (!scene.sim.sources.empty()) return std::nullopt;
  return static_cast<double>(liquid.surfaceCells) * (h / spacing) * (h / spacing);
}

double plannedMemory(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid,
                     const std::optional<double>& points) {
  return kBytesProgram + kBytesPerLiquidCell * static_cast<double>(liquid.cells) +
         kBytesPerPoint * points.value_or(0.0) + kBytesPerPixel * scene.render.width * scene.render.height;
}

double plannedMemory(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid) {
  return plannedMemory(scene, liquid, plannedPoints(scene, liquid));
}

}  // namespace fluidtex::tools
