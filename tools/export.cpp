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

Command exportCommand() {
  const auto options = std::make_shared<CommonOptions>();
  Command command{"export", "Write the surfaces of a finished run in other formats"};
  command.options = {{"out", &options->out, "OUT", "Folder of the run", {.required = true}}};
  append(command.options, formatOptions(*options));
  Option& format = named(command.options, "--format");
  format.takes.required = true;
  format.text = "glb, obj, usda, vtp, with commas between several";
  append(command.options,
         {exemplarOfRun(options->exemplar), {"--quiet", &options->quiet, "", "No progress, only errors"}});
  command.footer = "Example:\n  fluidtex export out/dam_break --format glb,vtp";
  command.run = [options] {
    exportRun(*options);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
