// fluidtex_joints OUT FRAME: how much joints stand out on a frame of a finished run. See
// tools/measure_joints.
#include "render/render.h"
#include "texture/exemplar/read_image.h"
#include "texture/exemplar/srgb.h"
#include "tools/base/atomic_file.h"
#include "tools/base/errors.h"
#include "tools/formats/read_ply.h"
#include "tools/joints/stand_out.h"
#include "tools/run_folder/finished_run.h"

#include <fmt/core.h>
#include <openvdb/openvdb.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>

namespace fluidtex::joints {
namespace {

namespace fs = std::filesystem;
using tools::Json;
using tools::UsageError;

struct Settings {
  fs::path out, between, json, pictures;
  int frame = 0;
  std::array<int, 2> size{1280, 720};
  double fov = 12.0;
};

render::CameraRays cameraOf(const tools::FinishedRun& run, const Settings& settings) {
  try {
    const Json &scene = run.report.at("scene"), &own = scene.at("camera");
    const auto vector = [&](const char* key) {
      const auto v = own.at(key).get<std::array<double, 3>>();
      return render::Vec3d(v[0], v[1], v[2]);
    };
    const int frames = scene.at("frames");
    const double progress = frames > 1 ? double(settings.frame - 1) / (frames - 1) : 0.0;
    return render::makeCamera({vector("from"), vector("at"), settings.fov, own.at("turn")}, settings.size[0],
                              settings.size[1], progress);
  } catch (const Json::exception&) {
    throw UsageError((run.out / "run.json").string() + ": says nothing of the scene's camera");
  }
}

texture::TexturedSurface surfaceOf(const tools::FinishedRun& run, int frame) {
  if (std::find(run.frames.begin(), run.frames.end(), frame) == run.frames.end())
    throw UsageError(fmt::format("{}: is not there; give a frame that has a surface, {} to {}",
                                 run.surfaceOf(frame).string(), run.frames.front(), run.frames.back()));
  texture::TexturedSurface surface = tools::readPly(run.surfaceOf(frame), run.color.width, run.color.height);
  if (!run.looksUp || surface.empty() || tools::lacksGradients(surface))
    throw UsageError(run.surfaceOf(frame).string() +
                     ": has no joints; give a run whose colours are looked up in the exemplar");
  surface.spacing = tools::spacingOf(run, surface, frame);
  return surface;
}

double shareOf(const Seen& seen, Kind kind) {
  const auto all =
      std::count_if(seen.kind.begin(), seen.kind.end(), [](Kind k) { return k != Kind::nothing; });
  return all == 0 ? 0.0 : double(std::count(seen.kind.begin(), seen.kind.end(), kind)) / double(all);
}

Json jsonOf(const Contrast& contrast) {
  return {{"gradient", contrast.gradient},
          {"steps", contrast.steps},
          {"deviation", contrast.deviation},
          {"pixels", contrast.pixels}};
}

// The lightness of each way as 1.png, 2.png, ..., and joints in white on grey as joints.png.
void writePictures(const Seen& seen, const fs::path& folder) {
  const auto write = [&](const std::string& name, const auto& lightness) {
    render::Picture picture{seen.width, seen.height, {}};
    for (std::size_t pixel = 0; pixel < seen.kind.size(); ++pixel)
      picture.rgb.insert(picture.rgb.end(), 3, texture::decodeSrgb(lightness(pixel)));
    tools::writeAtomically(folder / (name + ".png"),
                           [&](const fs::path& file) { render::writePng(picture, file); });
  };
  for (std::size_t way = 0; way < seen.lightness.size(); ++way)
    write(std::to_string(way + 1), [&](std::size_t pixel) { return seen.lightness[way][pixel]; });
  write("joints", [&](std::size_t pixel) {
    return seen.kind[pixel] == Kind::joint ? 1.0f : seen.kind[pixel] == Kind::elsewhere ? 0.5f : 0.0f;
  });
}

Json figuresOf(const tools::FinishedRun& run, const Settings& settings) {
  const texture::TexturedSurface surface = surfaceOf(run, settings.frame);
  const texture::Detail detail =
      texture::makeDetail(settings.between.empty() ? run.color : texture::readImage(settings.between),
                          run.toroidal, run.color.width);
  const texture::Joints joints = texture::findJoints(surface, run.toroidal);
  const texture::CutSurface cut = texture::cutAtJoints(surface, run.toroidal);
  const texture::Joints cutJoints = texture::findJoints(cut.surface, run.toroidal);
  const std::vector<Way> ways = waysToDraw(detail, surface, joints, cut, cutJoints);
  const Seen seen = look(surface, joints, cut, run.toroidal, ways, cameraOf(run, settings),
                         {settings.size[0], settings.size[1]});
  const auto several =
      std::count_if(joints.joints.begin(), joints.joints.end(),
                    [torus = texture::Torus(surface, run.toroidal)](const texture::Joint& joint) {
                      return isOfSeveralPieces(joint, torus);
                    });

  if (!settings.pictures.empty()) writePictures(seen, settings.pictures);
  Json rows = Json::array();
  for (std::size_t way = 0; way < ways.size(); ++way)
    rows.push_back({{"way", ways[way].name},
                    {"joints", jsonOf(contrastOf(seen, way, Kind::joint, surface.spacing))},
                    {"elsewhere", jsonOf(contrastOf(seen, way, Kind::elsewhere, surface.spacing))}});
  for (const Kind kind : {Kind::joint, Kind::elsewhere})
    if (contrastOf(seen, 0, kind, surface.spacing).gradients == 0)
      throw UsageError(fmt::format("the picture shows nothing {} joints; give another frame or --fov",
                                   kind == Kind::joint ? "in" : "outside of"));
  return {{"scene", run.report["scene"].value("name", "")},
          {"frame", settings.frame},
          {"points", surface.positions.size()},
          {"size", settings.size},
          {"joint_triangles", double(several) / double(surface.triangles.size())},
          {"joint_pixels", shareOf(seen, Kind::joint)},
          {"cut_vertices", double(cut.surface.positions.size()) / double(surface.positions.size())},
          {"ways", rows}};
}

void print(const Json& figures) {
  fmt::print("frame {}: {} points, joints are {:.1f}% of the triangles and {:.1f}% of the surface's pixels\n",
             figures["frame"].get<int>(), figures["points"].get<std::size_t>(),
             100 * figures["joint_triangles"].get<double>(), 100 * figures["joint_pixels"].get<double>());
  fmt::print("{:<40}{:>12}{:>12}{:>12}{:>12}\n", "", "gradient", "steps", "elsewhere", "deviation");
  for (const Json& row : figures["ways"]) {
    const auto value = [&](const char* where, const char* key) { return row[where][key].get<double>(); };
    fmt::print("{:<40}{:>12.2f}{:>11.1f}%{:>11.1f}%{:>12.2f}\n", row["way"].get<std::string>(),
               value("joints", "gradient") / value("elsewhere", "gradient"), 100 * value("joints", "steps"),
               100 * value("elsewhere", "steps"),
               value("joints", "deviation") / value("elsewhere", "deviation"));
  }
}

}  // namespace
}  // namespace fluidtex::joints

int main(int argc, char** argv) {
  using namespace fluidtex;
  joints::Settings settings;
  CLI::App app("Measures how much joints stand out on a frame of a finished run, drawn in several ways.",
               "fluidtex_joints");
  app.add_option("OUT", settings.out, "folder of the run")->required();
  app.add_option("FRAME", settings.frame, "number of the frame")->required();
  app.add_option("--size", settings.size, "of the picture, pixels")
      ->check(CLI::Range(1, 16384))
      ->capture_default_str();
  app.add_option("--fov", settings.fov, "vertical field of view of the scene's camera, degrees")
      ->capture_default_str();
  app.add_option("--between", settings.between,
                 "a finer picture of the run's exemplar, to look up in its place")
      ->take_last();
  app.add_option("--pictures", settings.pictures,
                 "a folder for what was seen: lightness, each way's, and joints");
  app.add_option("--json", settings.json, "writes the figures there too");
  CLI11_PARSE(app, argc, argv);
  openvdb::initialize();
  // What goes wrong is said once, on stderr.
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("joints", std::make_shared<spdlog::sinks::null_sink_mt>()));
  return tools::guarded([&] {
    const tools::Json figures = joints::figuresOf(tools::openRun(settings.out, {}), settings);
    joints::print(figures);
    if (!settings.json.empty()) tools::writeTextAtomically(settings.json, figures.dump(1) + "\n");
  });
}
