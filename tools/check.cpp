// fluidtex check SCENE: validate only, and print what a run would do.
#include "pipeline/foreseen_surface.h"
#include "pipeline/liquid_plan.h"
#include "pipeline/motion.h"
#include "pipeline/start_mesh.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/domain.h"
#include "texture/exemplar/exemplar.h"
#include "texture/labels/labels.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/two_digits.h"
#include "tools/base/work.h"
#include "tools/check_cache.h"
#include "tools/common_options.h"
#include "tools/frames/check_drawn_maps.h"
#include "tools/frames/color_between.h"
#include "tools/frames/disk_plan.h"
#include "tools/frames/exemplar_fit.h"
#include "tools/frames/image_notes.h"
#include "tools/frames/memory_plan.h"
#include "tools/frames/progress.h"
#include "tools/frames/time_plan.h"

#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <memory>

namespace fluidtex::tools {
namespace {

struct CheckOptions : CommonOptions {
  CheckCacheWishes cache;
};

void printPlannedPoints(const scenes::Scene& scene, const std::optional<double>& points) {
  const double spacing = scene.texture.spacing, foreseen = pipeline::foreseenSurface(scene);
  if (!points) {
    print("points    one every {:.4g} m, as many as what flows in needs\n", spacing);
  } else if (spacing > 0.0) {
    print("points    one every {:.4g} m, about {}\n", spacing, twoDigits(*points));
  } else if (foreseen > 0.0) {
    print("points    {} on the {} m2 that the liquid may come to, one every {:.4g} m or more\n",
          scene.texture.points, twoDigits(foreseen), pipeline::foreseenSpacing(scene));
  } else {
    print("points    {} on the first surface; the spacing then stays\n", scene.texture.points);
  }
}

// As a run with these options would take it.
void tellDisk(const scenes::Scene& scene, const CheckOptions& options, int frames, double cells,
              double points, double copied) {
  if (points <= 0.0) return;
  const DiskPlan plan =
      plannedDisk(scene, frames, points, cells, copied, true, parseFormats(options.formats));
  print("disk      {}\n", textOf(plan));
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("out") / scene.name : options.out;
  if (const std::string note = diskNote(plan, out); !note.empty()) say("warning: {}\n", note);
}

int threadsOf(const CommonOptions& options) {
  return options.threads > 0 ? options.threads : tbb::this_task_arena::max_concurrency();
}

// Frames up to `last` are computed, whichever are written.
void printTime(const scenes::Scene& scene, const CommonOptions& options, const PlannedTime& time, int last) {
  const auto seconds = [](double value) {
    return value < 9.5 ? fmt::format("{:.1g} s", value) : fmt::format("{:.0f} s", value);
  };
  print("time      about {} a frame on {} threads: simulate {}, texture {}, render {}; ",
        seconds(time.frame()), threadsOf(options), seconds(time.simulate), seconds(time.texture),
        seconds(time.render));
  print("the first texture {}; {} in all{}\n", seconds(time.firstTexture),
        humanDuration(time.frame() * (last - 1) + time.firstTexture + time.render),
        scene.sim.sources.empty() ? "" : ", and more for what flows in");
  if (const std::string note = waysNote(scene.texture.orientation); !note.empty())
    print("          {}\n", note);
}

// Of the mesh that the liquid begins with.
void printStart(const scenes::Scene& scene, const texture::Image& picture) {
  if (!pipeline::beginsWithMesh(scene)) return;
  const texture::TexturedSurface start = pipeline::startSurface(scene, picture.width, picture.height);
  double area = 0.0, worn = 0.0;
  for (const texture::Vec3I& t : start.triangles) {
    const texture::Vec3f& a = start.positions[t[0]];
    const double size = (start.positions[t[1]] - a).cross(start.positions[t[2]] - a).length();
    area += size;
    if (double(texture::stretch(start.gradient[t[0]], scene.texture.spacing)) >
        scene.texture.synthesis.keepStretch)
      worn += size;
  }
  print(
      "start     the texture of {}, its picture halved {} times; {:.0f}% of it are stretched beyond "
      "keep_stretch{}\n",
      scene.start.mesh.file.string(), scene.texture.exemplar.halvings, 100.0 * worn / area,
      scene.start.renew ? ", and soon renewed" : ", and stay so");
}

void printPlan(const scenes::Scene& scene, const CheckOptions& options) {
  int first = 1, last = 0;
  parseFrames(options.frames, scene, first, last);
  nowAt(kOnExemplar);
  const texture::Exemplar exemplar =
      texture::loadExemplar(scene.texture.exemplar, scene.texture.synthesis, scene.texture.surface.levels);
  const std::optional<texture::Detail> detail = detailOf(scene.texture);
  checkDrawnMaps(scene.render, exemplar);
  if (options.quiet) return;
  std::vector<ComparedFrames> compared;
  if (scene.motion.flow == sim::MotionKind::files)
    compared = compareFrames(scene, first, last, options.cache);
  nowAt(kOnMotion);
  const double h = scene.sim.voxelSize();
  const pipeline::LiquidPlan liquid = pipeline::planLiquid(scene.sim);
  const openvdb::Coord cells = sim::cellCount(scene.sim.size, h);
  print("{}: valid\n", scene.file.string());
  print("frames    {} to {} of {}, {:g} a second, {:.3g} s in all\n", first, last, scene.frames,
        scene.sim.frameRate, (scene.frames - 1) / scene.sim.frameRate);
  const bool endless = sim::isEndless(sim::domainCells(scene.sim));
  if (scene.motion.flow != sim::MotionKind::files) {
    print("grid      {} x {} x {} cells of {:.4g} m{}\n", cells.x(), cells.y(), cells.z(), h,
          endless ? ", and on without bounds where liquid gets to" : "");
    print("liquid    {} cells at the start, {:.4g} m3", liquid.atStart,
          static_cast<double>(liquid.atStart) * h * h * h);
    if (liquid.cells != liquid.atStart) print("; {} cells once all is poured", liquid.cells);
    print("\n");
  }
  const double spacing = scene.texture.spacing;
  std::optional<double> points = plannedPoints(scene, liquid);
  if (const double onFiles = printPoints(scene, compared); onFiles > 0.0)
    points = onFiles;
  else
    printPlannedPoints(scene, points);
  const texture::AnimationOptions& animation = scene.texture.exemplar.animation;
  print("exemplar  {}, {} x {} pixels{}\n",
        (animation.files.empty() ? scene.texture.exemplar.file : animation.pattern).string(),
        exemplar.color.width, exemplar.color.height, scene.texture.exemplar.toroidal ? ", toroidal" : "");
  printStart(scene, exemplar.color);
  if (!animation.files.empty())
    print("animation {} pictures, {}\n", animation.files.size(),
          animation.by == texture::ShowBy::guidance
              ? std::string("which guidance chooses")
              : fmt::format("{:g} a second, {}", animation.rate, animation.loop ? "over and over" : "once"));
  const double pixels = double(exemplar.color.width) * exemplar.color.height;
  print("texture   one point shows one pixel: ");
  if (spacing > 0.0)
    print("the exemplar is {:.3g} x {:.3g} m", spacing * exemplar.color.width,
          spacing * exemplar.color.height);
  if (points) print("{}{:.2g} exemplars cover the surface", spacing > 0.0 ? ", and " : "", *points / pixels);
  print("\n");
  if (const std::string note =
          fitNote(scene.texture, exemplar.color.width, exemplar.color.height, points.value_or(0.0));
      !note.empty())
    print("          {}\n", note);
  print("guidance  {}\n", exemplar.guided ? scene.texture.exemplar.guidance.string()
                          : animation.by == texture::ShowBy::guidance ? std::string("chooses pictures")
                                                                      : std::string("none"));
  for (const texture::MapOptions& map : scene.texture.exemplar.maps) {
    const bool matched = map.weight > 0.0 && exemplar.mapChannels > 0;
    print("map       {}, {}\n", map.name,
          matched            ? fmt::format("matched with weight {:g}", map.weight)
          : map.weight > 0.0 ? "looked up: matched it would be by method = \"coordinates\", if it were not "
                               "the same everywhere"
                             : "looked up");
  }
  if (exemplar.mapChannels > 0)
    print("matching  {} take {} channel{}, which hold{} {:.0f}% of their differences\n",
          animation.files.empty() ? "maps" : "the later pictures", exemplar.mapChannels,
          exemplar.mapChannels > 1 ? "s" : "", exemplar.mapChannels > 1 ? "" : "s",
          100.0 * exemplar.mapShare);
  if (detail)
    print("between   the points, a picture of {} x {} pixels is looked up\n", detail->color.width,
          detail->color.height);
  print("pictures  {} x {}, {} paths a pixel{}\n", scene.render.width, scene.render.height,
        scene.render.samples,
        scene.render.noise > 0.0 ? fmt::format(" or a noise of {}", scene.render.noise) : "");
  const double memory =
      plannedMemory(scene, liquid, points, parseFormats(options.formats), jointsAs(options));
  print("memory    about {} GB", twoDigits(memory / 1e9));
  // How much sources bring cannot be told beforehand.
  if (!scene.sim.sources.empty()) print(", and {:.0f} kB a cell of what flows in", kBytesPerLiquidCell / 1e3);
  print("\n");
  const bool finer = detail && !scene.texture.exemplar.betweenFile.empty();
  const double copied = pixels * (scenes::showsMovingPicture(scene) ? 2 + last - first : 1) +
                        (finer ? double(detail->color.width) * detail->color.height : 0.0);
  tellDisk(scene, options, last - first + 1, double(liquid.cells), points.value_or(0.0), copied);
  if (points)
    printTime(scene, options, plannedTime(scene, liquid, *points, pixels, threadsOf(options)), last);
  for (const std::string& note : imageNotes(colorPictures(scene.texture.exemplar)))
    say("warning: {}\n", note);
  for (const std::string& warning : pipeline::warningsOf(scene)) say("warning: {}\n", warning);
}

void check(const CheckOptions& options) {
  if (isCache(options.scene) && options.exemplar.empty()) return checkCache(options, options.cache);
  const scenes::Scene scene = loadScene(options);
  atItsLine(options, scene, [&] { printPlan(scene, options); });
}

}  // namespace

Command checkCommand() {
  const auto options = std::make_shared<CheckOptions>();
  Command command{"check", "Validate a scene or a cache, and print what is in it"};
  command.options = sceneOptions(*options);
  append(command.options, formatOptions(*options));
  append(command.options, {{"--pairs",
                            &options->cache.pairs,
                            "N",
                            "Of a cache: how many pairs of frames are compared (default: 5)",
                            {.least = 1, .most = 9999}},
                           {"--json", &options->cache.json, "FILE",
                            "Of a cache: write what the pairs of frames say to this file"}});
  command.footer =
      "Examples:\n  fluidtex check scenes/dam_break.toml --quality final\n  fluidtex check cache_fluid";
  command.run = [options] {
    check(*options);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
