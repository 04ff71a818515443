// Universal Scene Description, text (Pixar, OpenUSD): UsdGeomMesh, UsdPreviewSurface, value clips.
#pragma once

#include "tools/formats/appearance.h"
#include "tools/formats/export_mesh.h"

#include <iosfwd>

namespace fluidtex::tools {

// Writes the text of one frame's .usda: /liquid/surface with values at the time code `frame`, and a material
// that looks the picture up; without a picture, or where joints blend, there is none, and programs show
// displayColor. Metres, Z up. points, normals, velocities (m/s); primvars:displayColor (linear) and
// displayOpacity; UV sets with indices, faceVarying, origin lower left; every other column as a primvar of
// the vertices (`joint` of the corners).
void writeUsda(const ExportMesh& mesh, const Appearance& appearance, std::ostream& out);

// Writes the text of the stage beside the folder: the mesh over these frames, ascending and at least one.
// Each value is taken from its frame's file (value clips), so that nothing is there twice. `fullest`, one of
// the frames, says which attributes there are, and is what programs show that know no clips.
void writeUsdStage(const std::vector<int>& frames, int fullest, double frameRate, std::ostream& out);

}  // namespace fluidtex::tools
