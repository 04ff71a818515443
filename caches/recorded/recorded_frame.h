// Files of the program's own frames: what the solver gave, bit for bit, so that texture goes on from them.
#pragma once

#include "sim/frame/frame.h"

#include <filesystem>

namespace fluidtex::caches {

// Writes a frame on cells of side h as one OpenVDB file: grids "surface" and "solid" (level sets, metres),
// "u.0", "v.0", "w.0", "u.1", ... of the substeps (m/s, at faces), the fields by their names, and what thin
// walls hide (caches/recorded/recorded_sight.h). Lengths of substeps and statistics are the file's metadata.
// Throws openvdb::IoError.
void writeRecordedFrame(const sim::Frame& frame, double h, const std::filesystem::path& file);

// The same frame. Throws LayoutError where the file is missing, damaged, or no such frame.
sim::Frame readRecordedFrame(const std::filesystem::path& file);

}  // namespace fluidtex::caches
