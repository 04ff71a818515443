// fluidtex check SCENE: validate only, and print what a run would do.
#include "sim/mac_grid.h"
#include "sim/motion.h"
#include "texture/exemplar.h"
#include "tools/check_relief.h"
#include "tools/color_between.h"
#include "tools/common_options.h"
#include "tools/errors.h"
#include "tools/image_notes.h"
#include "tools/liquid_plan.h"

#include <fmt/core.h>

#include <memory>

namespace fluidtex::tools {
namespace {

// Near the dam break's measured peaks: 0.28 GB at 8,000 points, 0.57 GB at 58,000. What a cell takes is
// mostly the velocities of a frame's substeps, a dozen at a CFL number of 1. Leads, not promises.
constexpr double kBytesPerLiquidCell = 5000.0;
constexpr double kBytesPerPoint = 1000.0;
constexpr double kBytesProgram = 250e6;
// Of an exemplar that cover the surface: with less, no feature of a usual one is seen whole.
constexpr double kFewExemplars = 0.25;

void check(const CommonOptions& options) {
  const scenes::Scene scene = loadScene(options);
  int first = 1, last = 0;
  parseFrames(options.frames, scene.frames, first, last);
  const texture::Exemplar exemplar =
      texture::loadExemplar(scene.texture.exemplar, scene.texture.synthesis, scene.texture.surface.levels);
  const std::optional<texture::Detail> detail = detailOf(scene.texture);
  checkRelief(scene.render.bump, exemplar);
  if (options.quiet) return;
  const double h = scene.sim.voxelSize();
  const LiquidPlan liquid = planLiquid(scene.sim);
  const openvdb::Coord cells = sim::cellCount(scene.sim.size, h);
  fmt::print("{}: valid\n", scene.file.string());
  fmt::print("frames    {} to {} of {}, {:g} a second, {:.3g} s in all\n", first, last, scene.frames,
             scene.sim.frameRate, (scene.frames - 1) / scene.sim.frameRate);
  const bool endless = sim::isEndless(sim::domainCells(scene.sim));
  fmt::print("grid      {} x {} x {} cells of {:.4g} m{}\n", cells.x(), cells.y(), cells.z(), h,
             endless ? ", and on without bounds where liquid gets to" : "");
  fmt::print("liquid    {} cells at the start, {:.4g} m3", liquid.atStart,
             static_cast<double>(liquid.atStart) * h * h * h);
  if (liquid.cells != liquid.atStart) fmt::print("; {} cells once all is poured", liquid.cells);
  fmt::print("\n");
  // How much sources bring cannot be told beforehand.
  const bool fed = !scene.sim.sources.empty();
  const double spacing = scene.texture.spacing;
  const bool counted = spacing <= 0.0 || !fed;
  double points = scene.texture.points;
  if (!counted) {
    points = 0.0;
    fmt::print("points    one every {:.4g} m, as many as what flows in needs\n", spacing);
  } else if (spacing > 0.0) {
    points = static_cast<double>(liquid.surfaceCells) * (h / spacing) * (h / spacing);
    fmt::print("points    one every {:.4g} m, about {:.2g}\n", spacing, points);
  } else {
    fmt::print("points    {} on the first surface; the spacing then stays\n", scene.texture.points);
  }
  fmt::print("exemplar  {}, {} x {} pixels{}\n", scene.texture.exemplar.file.string(), exemplar.color.width,
             exemplar.color.height, scene.texture.exemplar.toroidal ? ", toroidal" : "");
  const double pixels = double(exemplar.color.width) * exemplar.color.height;
  fmt::print("texture   one point shows one pixel: ");
  if (spacing > 0.0)
    fmt::print("the exemplar is {:.3g} x {:.3g} m", spacing * exemplar.color.width,
               spacing * exemplar.color.height);
  if (counted)
    fmt::print(
        "{}{:.2g} exemplars cover the surface{}", spacing > 0.0 ? ", and " : "", points / pixels,
        points < kFewExemplars * pixels ? "; more points, or a smaller image, would show more of it" : "");
  fmt::print("\n");
  fmt::print("guidance  {}\n",
             exemplar.guided ? scene.texture.exemplar.guidance.string() : std::string("none"));
  for (const texture::MapOptions& map : scene.texture.exemplar.maps) {
    const bool matched = map.weight > 0.0 && exemplar.mapChannels > 0;
    fmt::print("map       {}, {}\n", map.name,
               matched ? fmt::format("matched with weight {:g}", map.weight)
               : map.weight > 0.0
                   ? "looked up: matched it would be by method = \"coordinates\", if it were not "
                     "the same everywhere"
                   : "looked up");
  }
  if (exemplar.mapChannels > 0)
    fmt::print("matching  maps take {} channel{}, which hold{} {:.0f}% of their differences\n",
               exemplar.mapChannels, exemplar.mapChannels > 1 ? "s" : "", exemplar.mapChannels > 1 ? "" : "s",
               100.0 * exemplar.mapShare);
  if (detail)
    fmt::print("between   the points, a picture of {} x {} pixels is looked up\n", detail->color.width,
               detail->color.height);
  fmt::print("pictures  {} x {}, {} paths a pixel\n", scene.render.width, scene.render.height,
             scene.render.samples);
  const double bytes =
      kBytesProgram + kBytesPerLiquidCell * static_cast<double>(liquid.cells) + kBytesPerPoint * points;
  fmt::print("memory    about {:.2g} GB", bytes / 1e9);
  if (fed) fmt::print(", and {:.0f} kB a cell of what flows in", kBytesPerLiquidCell / 1e3);
  fmt::print("\n");
  for (const std::string& note : imageNotes(colorPictures(scene.texture.exemplar)))
    fmt::print(stderr, "warning: {}\n", note);
  for (const std::string& warning : sim::warningsOf(sim::makeMotion(scene.sim, scene.motion)))
    fmt::print(stderr, "warning: {}\n", warning);
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
