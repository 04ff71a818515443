// OUT/state: what --resume continues from. One folder a frame, OUT/state/0007, replaced as a whole; only the
// newest stays.
#pragma once

#include "sim/solver.h"
#include "texture/surface.h"

#include <filesystem>
#include <optional>
#include <string>

namespace fluidtex::tools {

struct RunState {
  sim::State solver;
  texture::TexturedSurface surface;  // of that frame: what the next one carries over
  std::string report;                // run.json as far as it went
};

// Throws std::system_error or openvdb::IoError when the disk refuses.
void saveState(const RunState& state, const std::filesystem::path& stateFolder);

// The newest state in the folder; nothing if there is none. Throws std::runtime_error when it is damaged.
std::optional<RunState> loadState(const std::filesystem::path& stateFolder);

// Bit for bit what writeSurface() got; exposed for tests. Throws std::runtime_error, naming the file, when it
// is cut short or is no such file.
void writeSurface(const texture::TexturedSurface& surface, const std::filesystem::path& file);
texture::TexturedSurface readSurface(const std::filesystem::path& file);

}  // namespace fluidtex::tools
