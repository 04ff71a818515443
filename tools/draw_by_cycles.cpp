#include "tools/draw_by_cycles.h"

#include "render/frame_name.h"
#include "render/other_program.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <unistd.h>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

fs::path blender() {
  std::istringstream folders(variable("PATH"));
  for (std::string folder; std::getline(folders, folder, ':');)
    if (fs::path program = fs::path(folder) / "blender";
        access(program.c_str(), X_OK) == 0 && !fs::is_directory(program))
      return program;
  throw std::runtime_error(
      "--cycles: blender is not installed: apt-get install --no-install-recommends blender");
}

// What render.py is asked for; it says there what is what.
Json asked(const scenes::Scene& scene, const fs::path& run, const CyclesOptions& options) {
  Json maps = Json::object();
  for (const auto& [kind, file] : options.maps) maps[kind] = fs::absolute(file).string();
  const auto& origin = scene.domainOrigin;
  return {{"run", fs::absolute(run).string()},
          {"scene", Json::parse(scene.resolved)},
          {"origin", {origin.x(), origin.y(), origin.z()}},
          {"frames", Json::array()},
          {"pictures", nullptr},
          {"shutter", options.shutter.value_or(scene.render.camera.shutter)},
          {"shader", options.shader},
          {"maps", maps},
          {"height", options.height ? Json(*options.height) : Json(nullptr)},
          {"blend", nullptr}};
}

// The number behind `key` in a line such as "Fra:3 Mem:20.1M | ... | Sample 12/64".
double numberBehind(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(key);
  return at == line.npos ? 0.0 : std::strtod(line.c_str() + at + key.size(), nullptr);
}

render::Picture lightOf(const fs::path& file, int width, int height) {
  render::Picture picture{width, height, std::vector<float>(std::size_t(3) * width * height)};
  std::ifstream in(file, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(picture.rgb.size() * sizeof(float));
  if (!in.read(reinterpret_cast<char*>(picture.rgb.data()), bytes) || in.peek() != EOF)
    throw std::runtime_error(
        fmt::format("blender: {} is not of {} x {} pixels", file.string(), width, height));
  in.close();
  fs::remove(file);
  return picture;
}

// The sentence of render.py, or Blender's last words.
[[noreturn]] void fail(const render::Outcome& outcome) {
  constexpr const char* kOurs = "error: ";
  std::istringstream lines(outcome.complaints);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(kOurs)) throw UsageError(line.substr(std::string(kOurs).size()));
  throw std::runtime_error("blender: " + render::lastLine(outcome.complaints));
}

void tellWarning(const std::string& line) {
  if (line.starts_with("warning: ")) say("{}\n", line);
}

// temporary: where Blender puts what it makes for itself.
void runBlender(const Json& asked, int threads, const fs::path& temporary,
                const render::Meanwhile& meanwhile) {
  // It goes when this program is killed. Debian's Blender takes the Python that comes first, which has to be
  // Debian's.
  std::vector<std::string> words{"setpriv",
                                 "--pdeathsig",
                                 "KILL",
                                 "env",
                                 "PATH=/usr/bin:" + variable("PATH"),
                                 "TMPDIR=" + fs::absolute(temporary).string(),
                                 blender().string()};
  words.insert(words.end(), {"-b", "--factory-startup", "-noaudio", "--python-exit-code", "1"});
  if (threads > 0) words.insert(words.end(), {"-t", std::to_string(threads)});
  words.insert(words.end(), {"-P", (blenderScripts() / "render.py").string()});
  const render::Outcome outcome = render::runOther(words, asked.dump(), meanwhile);
  if (meanwhile.stop && meanwhile.stop()) throw Interrupted("--missing");
  if (outcome.exitCode != 0) fail(outcome);
}

}  // namespace

fs::path blenderScripts() {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  for (const fs::path& folder :
       {program.parent_path().parent_path() / "share" / "fluidtex" / "blender", fs::path(FLUIDTEX_BLENDER)})
    if (fs::exists(folder / "render.py", unknown)) return folder;
  throw std::runtime_error(fmt::format("{}: is not there; install fluidtex again",
                                       (fs::path(FLUIDTEX_BLENDER) / "render.py").string()));
}

void drawByCycles(const scenes::Scene& scene, const fs::path& run, const std::vector<int>& frames,
                  const CyclesOptions& options, int threads, const fs::path& scratch,
                  const CyclesReceiver& receiver) {
  Json wish = asked(scene, run, options);
  wish["frames"] = frames;
  wish["pictures"] = fs::absolute(scratch).string();
  std::size_t done = 0;
  const auto hear = [&](const std::string& line) {
    tellWarning(line);
    const int frame = int(numberBehind(line, line.starts_with("Fra:") ? "Fra:" : "frame "));
    if (line == fmt::format("frame {}", frame)) {
      ++done;
      receiver.picture(frame, lightOf(scratch / (render::frameName(frame) + ".light"), scene.render.width,
                                      scene.render.height));
    } else if (const double sample = numberBehind(line, "| Sample "); sample > 0.0 && receiver.progress) {
      receiver.progress(frame, sample / scene.render.samples);
    }
  };
  runBlender(wish, threads, scratch, {hear, receiver.stop});
  if (done < frames.size()) throw std::runtime_error("blender: has ended before all pictures were drawn");
}

void saveForBlender(const scenes::Scene& scene, const fs::path& run, const CyclesOptions& options,
                    const fs::path& blend) {
  writeAtomically(fs::absolute(blend), [&](const fs::path& file) {
    Json wish = asked(scene, run, options);
    wish["blend"] = file.string();
    runBlender(wish, 0, fs::temp_directory_path(), {tellWarning, {}});
  });
}

}  // namespace fluidtex::tools
