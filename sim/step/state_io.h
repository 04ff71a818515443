// A state of the solver as a file.
#pragma once

#include "sim/step/liquid.h"

#include <filesystem>

namespace fluidtex::sim {

// The state as one .vdb file, uncompressed so that every value returns bit for bit.
// Throws openvdb::IoError when the file cannot be written or read.
void writeState(const State& state, const std::filesystem::path& file);
State readState(const std::filesystem::path& file);

}  // namespace fluidtex::sim
