// OUT/state: what --resume continues from. One folder a frame, OUT/state/0007, replaced as a whole; only the
// newest stays. In it the solver's grids, the surface, the report of that frame, and a manifest with the size
// and the hash of each, by which a damaged file is noticed. Beside them the journal of the frames before.
#pragma once

#include "sim/step/solver.h"
#include "texture/surface.h"

#include <filesystem>
#include <optional>
#include <string>

namespace fluidtex::tools {

// What is read back.
struct RunState {
  sim::State solver;
  texture::TexturedSurface surface;  // of that frame: what the next one carries over
  std::string report;                // run.json, of its frames the last
};

// Throws std::system_error, std::runtime_error or openvdb::IoError when the disk refuses.
void saveState(const sim::State& solver, const texture::TexturedSurface& surface, const std::string& report,
               const std::filesystem::path& stateFolder);

// The newest state in the folder; nothing if there is none. Throws std::runtime_error when a file of it is
// missing, cut short or changed, with one sentence that names it, and openvdb::IoError when solver.vdb is
// whole but no state.
std::optional<RunState> loadState(const std::filesystem::path& stateFolder);

// Removes all states, the journal, and the folder if nothing else is in it.
void removeStates(const std::filesystem::path& stateFolder);

// Bit for bit what writeSurface() got; exposed for tests. writeSurface() throws std::system_error when the
// disk refuses. readSurface() throws std::runtime_error, naming the file, when it is cut short, goes on too
// long, is no such file, or holds arrays or triangles that do not fit together.
void writeSurface(const texture::TexturedSurface& surface, const std::filesystem::path& file);
texture::TexturedSurface readSurface(const std::filesystem::path& file);

}  // namespace fluidtex::tools
