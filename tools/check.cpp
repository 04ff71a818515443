// fluidtex check SCENE: validate only, and print what a run would do.
#include "sim/shapes.h"
#include "texture/exemplar.h"
#include "tools/common_options.h"
#include "tools/frame_loop.h"

#include <fmt/core.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <memory>

namespace fluidtex::tools {
namespace {

// Near the dam break's measured peaks, high for the largest: 0.27 GB at 8,000 points, 0.39 GB at 58,000, 0.80
// GB at 500,000. Leads, not promises.
constexpr double kBytesPerLiquidCell = 400.0;
constexpr double kBytesPerPoint = 1400.0;
constexpr double kBytesProgram = 245e6;

struct LiquidPlan {
  std::int64_t cells = 0;    // liquid cells once every body has been poured
  std::int64_t atStart = 0;  // at the first frame
};

LiquidPlan countLiquid(const sim::Options& sim) {
  const double h = sim.voxelSize();
  const openvdb::Vec3i count(static_cast<int>(std::lround(sim.size.x() / h)),
                             static_cast<int>(std::lround(sim.size.y() / h)),
                             static_cast<int>(std::lround(sim.size.z() / h)));
  std::vector<sim::ShapeDistance> liquid, solids;
  for (const auto& body : sim.liquid) liquid.emplace_back(body.shape, h);
  for (const auto& solid : sim.solids) solids.emplace_back(solid.shape, h);
  const auto slice = [&](int k) {
    LiquidPlan plan;
    for (int j = 0; j < count.y(); ++j)
      for (int i = 0; i < count.x(); ++i) {
        const sim::Vec3d x = h * sim::Vec3d(i + 0.5, j + 0.5, k + 0.5);
        bool ever = false, atStart = false;
        for (std::size_t b = 0; b < liquid.size(); ++b) {
          if (liquid[b](x) >= 0.0) continue;
          ever = true;
          atStart = atStart || sim.liquid[b].from <= 0.0;
        }
        for (std::size_t s = 0; s < solids.size() && ever; ++s)
          if (sim.solids[s].from <= 0.0 && solids[s](x) < 0.0) ever = atStart = false;
        plan.cells += ever;
        plan.atStart += atStart;
      }
    return plan;
  };
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, count.z()), LiquidPlan{},
      [&](const tbb::blocked_range<int>& range, LiquidPlan plan) {
        for (int k = range.begin(); k != range.end(); ++k) {
          const LiquidPlan here = slice(k);
          plan.cells += here.cells;
          plan.atStart += here.atStart;
        }
        return plan;
      },
      [](const LiquidPlan& a, const LiquidPlan& b) {
        return LiquidPlan{a.cells + b.cells, a.atStart + b.atStart};
      });
}

void check(const CommonOptions& options) {
  const scenes::Scene scene = loadScene(options);
  int first = 1, last = 0;
  parseFrames(options.frames, scene.frames, first, last);
  const texture::Exemplar exemplar =
      texture::loadExemplar(scene.texture.exemplar, scene.texture.synthesis, scene.texture.surface.levels);
  if (options.quiet) return;
  const double h = scene.sim.voxelSize();
  const LiquidPlan liquid = countLiquid(scene.sim);
  fmt::print("{}: valid\n", scene.file.string());
  fmt::print("frames    {} to {} of {}, {:g} a second, {:.3g} s in all\n", first, last, scene.frames,
             scene.sim.frameRate, (scene.frames - 1) / scene.sim.frameRate);
  fmt::print("grid      {:.0f} x {:.0f} x {:.0f} cells of {:.4g} m\n", scene.sim.size.x() / h,
             scene.sim.size.y() / h, scene.sim.size.z() / h, h);
  fmt::print("liquid    {} cells at the start, {:.4g} m3", liquid.atStart,
             static_cast<double>(liquid.atStart) * h * h * h);
  if (liquid.cells != liquid.atStart) fmt::print("; {} cells once all is poured", liquid.cells);
  fmt::print("\n");
  if (scene.texture.spacing > 0.0)
    fmt::print("points    one every {:.4g} m\n", scene.texture.spacing);
  else
    fmt::print("points    {} on the first surface; the spacing then stays\n", scene.texture.points);
  fmt::print("exemplar  {}, {} x {} pixels{}\n", scene.texture.exemplar.file.string(), exemplar.color.width,
             exemplar.color.height, scene.texture.exemplar.toroidal ? ", toroidal" : "");
  fmt::print("pictures  {} x {}, {} paths a pixel\n", scene.render.width, scene.render.height,
             scene.render.samples);
  const double bytes = kBytesProgram + kBytesPerLiquidCell * static_cast<double>(liquid.cells) +
                       kBytesPerPoint * scene.texture.points;
  fmt::print("memory    about {:.2g} GB\n", bytes / 1e9);
}

}  // namespace

void addCheck(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("check", "Validate a scene and print the plan");
  auto options = std::make_shared<CommonOptions>();
  addSceneOptions(*command, *options);
  command->footer("Example:\n  fluidtex check scenes/dam_break.toml --quality final");
  command->callback([options, &exitCode] { exitCode = guarded([&] { check(*options); }); });
}

}  // namespace fluidtex::tools
