// OUT/state: what --resume continues from. One folder per frame, OUT/state/0007, replaced as a whole; only
// the newest is kept. It holds the solver's grids, the surface, the frame's report, and a manifest with size
// and hash of each file, to detect damage. The journal of earlier frames is beside it.
#pragma once

#include "sim/step/solver.h"
#include "texture/surface.h"

#include <filesystem>
#include <optional>
#include <string>

namespace fluidtex::tools {

// A state as read.
struct RunState {
  sim::State solver;
  texture::TexturedSurface surface;  // of that frame, for transport to the next
  std::string report;                // run.json with the last frame only
};

// Throws std::system_error, std::runtime_error or openvdb::IoError of the disk.
void saveState(const sim::State& solver, const texture::TexturedSurface& surface, const std::string& report,
               const std::filesystem::path& stateFolder);

// The newest state in the folder; nothing if there is none. Throws std::runtime_error that names the file if
// one is missing, truncated or changed, and openvdb::IoError if solver.vdb is intact but no state.
std::optional<RunState> loadState(const std::filesystem::path& stateFolder);

// Removes all states, the journal, and the folder if it is empty then.
void removeStates(const std::filesystem::path& stateFolder);

// Exact binary serialisation, exposed for tests. writeSurface() throws std::system_error of the disk.
// readSurface() throws std::runtime_error that names the file if it is truncated, too long, of another kind,
// or holds arrays or triangles that do not fit together.
void writeSurface(const texture::TexturedSurface& surface, const std::filesystem::path& file);
texture::TexturedSurface readSurface(const std::filesystem::path& file);

}  // namespace fluidtex::tools
