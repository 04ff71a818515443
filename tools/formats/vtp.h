// VTK's XML format for surfaces, .vtp, and ParaView's list of a sequence, .pvd (Kitware, VTK File Formats).
#pragma once

#include "tools/formats/export_mesh.h"

#include <iosfwd>

namespace fluidtex::tools {

// Writes the bytes of a .vtp of a mesh whose joints are cut: arrays of points, raw behind the text. normal,
// color (RGBA, sRGB bytes), UV sets (origin lower left, as VTK has it) and all other columns under their own
// names.
void writeVtp(const ExportMesh& mesh, std::ostream& out);

// The text of a .pvd beside the folder: these frames, at their times.
std::string pvdOf(const std::vector<int>& frames, double frameRate);

}  // namespace fluidtex::tools
