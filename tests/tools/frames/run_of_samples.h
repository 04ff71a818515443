// The folder of a run whose frames all have the sample surface.
#pragma once

#include "render/frame_name.h"
#include "tests/tools/formats/sample_surface.h"
#include "texture/exemplar/image.h"
#include "tools/base/fingerprint.h"
#include "tools/formats/exports.h"
#include "tools/formats/ply.h"
#include "tools/run_folder/journal.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Of the size that the surface says.
inline texture::Image sampleColor() {
  return {8, 4, 4, std::vector<float>(8 * 4 * 4, 1.0f)};
}

inline Exports sampleExports(const std::vector<std::string>& formats) {
  Exports exports{parseFormats(formats), JointsAs::cut, {}};
  exports.appearance.name = "sample";
  exports.appearance.frameRate = 10.0;
  exports.appearance.picture = "exemplar.png";
  return exports;
}

// Its surfaces and their journal.
inline void makeRunOfSamples(const std::filesystem::path& out, int frames) {
  std::filesystem::create_directories(out / "surface");
  for (int frame = 1; frame <= frames; ++frame) {
    const std::string name = frameFile(Format::ply, frame);
    writePly(sampleSurface(), {}, out / name);
    addToJournal(out, {lineOfFile(name, fingerprintOf(out / name))});
  }
}

}  // namespace fluidtex::tools
