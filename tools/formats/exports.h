// The files of a run in the formats other than PLY, which ply.h writes.
#pragma once

#include "tools/formats/appearance.h"
#include "tools/formats/export_mesh.h"
#include "tools/formats/format.h"

#include <filesystem>

namespace fluidtex::tools {

struct Exports {
  std::vector<Format> formats;
  JointsAs joints = JointsAs::cut;  // of glb and usda; obj and vtp have them cut always
  Appearance appearance;
};

// Writes a frame's file in each of the formats but PLY, and what these refer to beside them. Whole files
// only, as writeAtomically().
void writeExports(const texture::TexturedSurface& surface, int frame, double time, const Exports& exports,
                  const std::filesystem::path& out);

// Brings the files up to date that list a sequence, OUT/NAME.usda and OUT/NAME.pvd: the frames whose files
// are there.
void updateSequences(const Exports& exports, const std::filesystem::path& out);

}  // namespace fluidtex::tools
