// fluidtex export OUT --format NAMES: the surfaces of a finished run in other formats.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/common_options.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/frames/export_frame.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/out_folder.h"

#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

void exportRun(const CommonOptions& options) {
  Exports exports{parseFormats(options.formats), jointsAs(options), {}};
  if (exports.formats.size() == 1)
    throw UsageError("export: PLY is there already; give --format glb, obj, usda or vtp");
  const OutFolder folder(existing(options.out));
  const FinishedRun run = openRun(options.out, options.exemplar);
  const Json& scene = run.report["scene"];
  exports.appearance = appearanceOf(scene, run.color);
  const bool between = exports.appearance.picture == kBetweenFile;
  writePictures(options.out, run.color, between ? fs::path(scene["texture"].value("between_file", "")) : "");
  for (const int frame : run.frames) {
    exportFrame(options.out, frame, exports, run.color);
    if (!options.quiet) say("frame {}\n", frame);
  }
}

}  // namespace

void addExport(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("export", "Write the surfaces of a finished run in other formats");
  auto options = std::make_shared<CommonOptions>();
  command->add_option("out", options->out, "Folder of the run")->required()->type_name("OUT");
  addFormatOptions(*command, *options);
  command->get_option("--format")
      ->required()
      ->description("glb, obj, usda, vtp, with commas between several");
  command
      ->add_option("--exemplar", options->exemplar, "The run's exemplar, where it is no longer at its place")
      ->type_name("IMAGE");
  command->add_flag("--quiet", options->quiet, "No progress, only errors");
  command->footer("Example:\n  fluidtex export out/dam_break --format glb,vtp");
  command->callback([options, &exitCode] { exitCode = guarded([&] { exportRun(*options); }); });
}

}  // namespace fluidtex::tools
