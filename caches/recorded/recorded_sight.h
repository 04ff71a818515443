// What thin walls hide in a frame's substeps, in the file of the frame.
#pragma once

#include "sim/frame/frame.h"

#include <openvdb/io/File.h>

#include <vector>

namespace fluidtex::caches {

// Adds grids "sight.0.0", "sight.0.1", "sight.1.0", ... (the words of sim::VisibleCells::bits) and to the
// metadata which of them is a substep's; nothing where all is visible.
void addSight(const sim::Frame& frame, openvdb::GridCPtrVec& grids, openvdb::MetaMap& metadata);

// Gives each substep its own; null where all is visible, and in files of versions that did not write it.
// Throws openvdb::Exception where the file is damaged.
void readSight(openvdb::io::File& file, std::vector<sim::Substep>& substeps);

}  // namespace fluidtex::caches
