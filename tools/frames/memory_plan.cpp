#include "tools/frames/memory_plan.h"

namespace fluidtex::tools {
namespace {

// Near the dam break's measured peaks: 0.28 GB at 8,000 points, 0.57 GB at 58,000. What a cell takes is
// mostly the velocities of a frame's substeps, a dozen at a CFL number of 1. Leads, not promises.
constexpr double kBytesPerPoint = 1000.0;
constexpr double kBytesProgram = 250e6;
// What a frame takes on top while it is written in other formats, of each mesh that these need
// (tools/formats): measured at 200,000 points, 10 MB with glb, 75 with glb and usda whose joints blend, 113
// with all four then.
constexpr double kBytesPerCutPoint = 100.0, kBytesPerBlendedPoint = 400.0;
// Light in its parts, what each pixel shows, and a level of the wavelet beside them.
constexpr double kRenderBytesPerPixel = 130.0;

double exportBytesPerPoint(const std::vector<Format>& formats, JointsAs joints) {
  bool cut = false, blended = false;
  for (const Format format : formats) {
    if (format == Format::ply) continue;
    const bool blends = joints == JointsAs::blend && (format == Format::glb || format == Format::usda);
    (blends ? blended : cut) = true;
  }
  return (cut ? kBytesPerCutPoint : 0.0) + (blended ? kBytesPerBlendedPoint : 0.0);
}

}  // namespace

std::optional<double> plannedPoints(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid) {
  const double spacing = scene.texture.spacing, h = scene.sim.voxelSize();
  if (spacing <= 0.0) return scene.texture.points;
  if (!scene.sim.sources.empty()) return std::nullopt;
  return static_cast<double>(liquid.surfaceCells) * (h / spacing) * (h / spacing);
}

double plannedMemory(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid,
                     const std::optional<double>& points, const std::vector<Format>& formats,
                     JointsAs joints) {
  return kBytesProgram + kBytesPerLiquidCell * static_cast<double>(liquid.cells) +
         (kBytesPerPoint + exportBytesPerPoint(formats, joints)) * points.value_or(0.0) +
         kRenderBytesPerPixel * scene.render.width * scene.render.height;
}

}  // namespace fluidtex::tools
