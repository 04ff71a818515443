#include "tools/frames/write_video.h"

#include "render/render.h"
#include "tools/base/atomic_file.h"
#include "tools/base/errors.h"

#include <stdexcept>

namespace fluidtex::tools {

std::filesystem::path videoFile(const scenes::Scene& scene, const std::filesystem::path& out) {
  return out / (scene.name + ".mp4");
}

void writeVideo(const scenes::Scene& scene, const std::filesystem::path& out, int first, int last,
                const std::atomic<bool>& stop, const std::string& onward) {
  try {
    writeAtomically(videoFile(scene, out), [&](const std::filesystem::path& file) {
      render::writeVideo(out / "frames", first, last, scene.sim.frameRate, file);
    });
  } catch (const std::runtime_error&) {
    // Ctrl-C reaches the encoder too, which then fails.
    if (stop) throw Interrupted(onward);
    throw;
  }
}

}  // namespace fluidtex::tools
