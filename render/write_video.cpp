// Runs the ffmpeg program.
#include "render/frame_name.h"
#include "render/other_program.h"
#include "render/render.h"

#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <string>

namespace fluidtex::render {
namespace {

// The folder as part of a file name pattern, in which a per cent sign has to be doubled.
std::string inPattern(const std::string& folder) {
  std::string out;
  for (const char c : folder) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

// How many frames a reader finds in the file, to its end: ffmpeg copies each packet and writes a line about
// it. Throws std::runtime_error with its last words where the file is cut short.
long framesIn(const std::filesystem::path& file) {
  const Outcome read =
      runOther({"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-xerror", "-f", "mp4", "-i",
                "file:" + file.string(), "-map", "0:v", "-c", "copy", "-f", "framecrc", "-"});
  if (read.exitCode != 0 || !read.complaints.empty())
    throw std::runtime_error("ffmpeg cannot read what it wrote: " + lastLine(read.complaints));
  long frames = 0;
  std::istringstream lines(read.output);
  for (std::string line; std::getline(lines, line);) frames += !line.starts_with('#');
  return frames;
}

}  // namespace

void writeVideo(const std::filesystem::path& folder, int first, int last, double frameRate,
                const std::filesystem::path& file) {
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file.string() + ": the video could not be written: " + why);
  };
  if (last < first) fail("there are no frames");
  if (!(frameRate > 0.0)) fail("the frame rate must be above 0");
  for (int frame = first; frame <= last; ++frame) {
    const std::filesystem::path picture = folder / (frameName(frame) + ".png");
    if (!std::filesystem::exists(picture)) fail(picture.string() + " is missing");
  }

  char rate[32];
  std::snprintf(rate, sizeof rate, "%.9g", frameRate);
  // H.264 in 4:2:0 needs even sizes: an odd last row or column is cut off.
  const std::string filter =
      "crop=trunc(iw/2)*2:trunc(ih/"
      "2)*2:0:0,scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,"
      "format=yuv420p";
  const std::vector<std::string> arguments{
      "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error",
      // Without it a disk that is full while the file is finished is complained of, and no failure.
      "-xerror", "-y", "-framerate", rate, "-start_number", std::to_string(first), "-i",
      inPattern(folder.string()) + "/%04d.png", "-frames:v", std::to_string(last - first + 1), "-vf", filter,
      "-c:v", "libx264", "-crf", "16", "-preset", "medium", "-colorspace", "bt709", "-color_primaries",
      "bt709", "-color_trc", "bt709", "-color_range", "tv",
      // A number of threads that does not hang on the machine, and no dates: the same frames give the same
      // bytes.
      "-threads", "4", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags",
      "+faststart", "-f", "mp4", "file:" + file.string()};
  // The encoder's own exit code does not tell of all that a disk can refuse: what it wrote is read back.
  std::string fault;
  try {
    const Outcome written = runOther(arguments);
    if (written.exitCode != 0)
      fault = "ffmpeg: " + lastLine(written.complaints);
    else if (const long found = framesIn(file); found != last - first + 1)
      fault = "it holds " + std::to_string(found) + " of " + std::to_string(last - first + 1) + " frames";
  } catch (const std::runtime_error& error) {
    fault = error.what();
  }
  if (!fault.empty()) fail(fault);
}

}  // namespace fluidtex::render
