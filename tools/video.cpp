// fluidtex video PICTURES: the video of pictures that are there already.
#include "render/frame_name.h"
#include "render/render.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"
#include "tools/run_folder/finished_run.h"

#include <fmt/core.h>

#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

struct VideoOptions {
  fs::path pictures, out;
  double rate = 0.0;  // frames a second; 0: the run's
};

// That of the run in whose folder the pictures' folder lies.
double rateOf(const fs::path& run) {
  const auto rate = "/scene/frame_rate"_json_pointer;
  if (fs::exists(run / "run.json"))
    if (const Json report = readReport(run); report.contains(rate) && report[rate].is_number())
      return report[rate].get<double>();
  throw UsageError(
      fmt::format("{}: no run says there how many frames a second; give --rate N", run.string()));
}

void makeVideo(const VideoOptions& options) {
  fs::path pictures = fs::absolute(options.pictures).lexically_normal();
  // "out/frames/" and "out/frames/." have an empty last name.
  if (!pictures.has_filename()) pictures = pictures.parent_path();
  const std::vector<int> frames = framesIn(pictures, ".png");
  if (frames.empty())
    throw UsageError(fmt::format("{}: holds no pictures 0001.png, 0002.png, ...", pictures.string()));
  for (std::size_t n = 1; n < frames.size(); ++n)
    if (frames[n] != frames[n - 1] + 1)
      throw UsageError(fmt::format("{}: is missing between {}.png and {}.png",
                                   (pictures / (render::frameName(frames[n - 1] + 1) + ".png")).string(),
                                   render::frameName(frames[n - 1]), render::frameName(frames[n])));
  const double rate = options.rate > 0.0 ? options.rate : rateOf(pictures.parent_path());
  const fs::path video = options.out.empty() ? fs::path(pictures.string() + ".mp4") : options.out;
  writeAtomically(video, [&](const fs::path& file) {
    render::writeVideo(pictures, frames.front(), frames.back(), rate, file);
  });
  print("{}\n", video.string());
}

}  // namespace

Command videoCommand() {
  const auto options = std::make_shared<VideoOptions>();
  Command command{"video", "Make a video of pictures 0001.png, 0002.png, ..."};
  command.options = {
      {"pictures", &options->pictures, "PICTURES", "Their folder", {.required = true}},
      {"--out", &options->out, "FILE", "The video (default: PICTURES.mp4)"},
      {"--rate",
       &options->rate,
       "N",
       "Frames a second (default: of the run in whose folder PICTURES lies)",
       {.least = 0.01, .most = 1000.0}},
  };
  command.footer = "Example:\n  fluidtex video out/dam_break/frames";
  command.run = [options] {
    makeVideo(*options);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
