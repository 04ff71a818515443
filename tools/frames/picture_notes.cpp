#include "tools/frames/picture_notes.h"

#include <fmt/core.h>

namespace fluidtex::tools {

std::vector<render::PictureNote> pictureNotes(const scenes::Scene& scene, int frame) {
  return {{"Title", scene.name},
          {"Frame", std::to_string(frame)},
          {"Time", fmt::format("{:.6g} s", (frame - 1) / scene.sim.frameRate)},
          {"Software", "fluidtex " FLUIDTEX_VERSION}};
}

}  // namespace fluidtex::tools
