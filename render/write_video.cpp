// Runs the ffmpeg program, without a shell.
#include "render/frame_name.h"
#include "render/render.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

extern char** environ;

namespace fluidtex::render {
namespace {

// The folder as part of a file name pattern, in which a per cent sign has to be doubled.
std::string inPattern(const std::string& folder) {
  std::string out;
  for (const char c : folder) out += c == '%' ? "%%" : std::string(1, c);
  return out;
}

struct Outcome {
  int exitCode = 0;   // or 128 + signal
  std::string words;  // all that it said
};

// Runs a program found on PATH with nothing to read, its output thrown away and its complaints gathered.
Outcome run(const std::vector<std::string>& arguments) {
  const auto fail = [&](int error) {
    throw std::runtime_error(arguments[0] + " could not be started: " + std::strerror(error));
  };
  int pipeEnds[2];
  if (pipe2(pipeEnds, O_CLOEXEC) != 0) fail(errno);

  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipeEnds[1], 2);
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipeEnds[1]);
  if (error != 0) {
    close(pipeEnds[0]);
    fail(error);
  }

  Outcome outcome;
  char buffer[4096];
  for (;;) {
    const ssize_t count = read(pipeEnds[0], buffer, sizeof buffer);
    if (count > 0) outcome.words.append(buffer, static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) break;
  }
  close(pipeEnds[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

// The last line that says anything.
std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \r\n");
  if (end == std::string::npos) return "it gave no reason";
  const std::size_t begin = text.find_last_of("\r\n", end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
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
      "ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y", "-framerate", rate, "-start_number",
      std::to_string(first), "-i", inPattern(folder.string()) + "/%04d.png", "-frames:v",
      std::to_string(last - first + 1), "-vf", filter, "-c:v", "libx264", "-crf", "16", "-preset", "medium",
      "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv",
      // A number of threads that does not hang on the machine, and no dates: the same frames give the same
      // bytes.
      "-threads", "4", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-movflags",
      "+faststart", "-f", "mp4", "file:" + file.string()};
  Outcome outcome;
  try {
    outcome = run(arguments);
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
  if (outcome.exitCode != 0) fail("ffmpeg: " + lastLine(outcome.words));
}

}  // namespace fluidtex::render
