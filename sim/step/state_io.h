// Files of the solver's state.
#pragma once

#include "sim/step/liquid.h"

#include <filesystem>

namespace fluidtex::sim {

// Write and read a state as one .vdb file, uncompressed so that every value returns bit for bit.
// Both throw openvdb::IoError when the file cannot be written or read.
void writeState(const State& state, const std::filesystem::path& file);
State readState(const std::filesystem::path& file);

}  // namespace fluidtex::sim
