#include "tools/earlier_run.h"

#include "render/frame_name.h"
#include "tools/atomic_file.h"
#include "tools/state.h"

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

void removeFrames(const fs::path& folder, const char* extension) {
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == extension && render::frameNumber(entry.path().stem().string()))
      fs::remove(entry.path());
  fs::remove(folder, missing);  // where nothing else is in it
}

}  // namespace

void removeLeftovers(const fs::path& out) {
  for (const char* folder : {"", "frames", "surface", "onto", "state"}) removeTemporaries(out / folder);
}

void clearEarlierRun(const fs::path& out, const std::string& sceneName) {
  fs::create_directories(out);
  removeLeftovers(out);
  removeStates(out / "state");
  fs::remove(out / "run.json");
  fs::remove(out / (sceneName + ".mp4"));
  removeFrames(out / "frames", ".png");
  removeFrames(out / "surface", ".ply");
  removeFrames(out / "onto", ".ply");
  if (fs::exists(out / "log.txt")) fs::resize_file(out / "log.txt", 0);
}

fs::path missingResult(const fs::path& out, int first, int last, bool rendered) {
  for (int frame = first; frame <= last; ++frame) {
    const std::string name = render::frameName(frame);
    const fs::path picture = fs::path("frames") / (name + ".png"),
                   surface = fs::path("surface") / (name + ".ply");
    if (rendered && !fs::exists(out / picture)) return picture;
    if (!fs::exists(out / surface)) return surface;
  }
  return {};
}

}  // namespace fluidtex::tools
