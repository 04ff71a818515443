// glTF 2.0, binary. Khronos Group, glTF 2.0 Specification (2021), with KHR_materials_clearcoat.
#pragma once

#include "tools/formats/appearance.h"
#include "tools/formats/export_mesh.h"

#include <iosfwd>

namespace fluidtex::tools {

// Writes the bytes of a .glb. Numbers stay in metres with Z up; the node turns them to glTF's Y up.
// Attributes: POSITION, NORMAL, TEXCOORD_n in the order st (st1 st2) fade_st (fade_st1 fade_st2); all other
// columns under their name in capitals behind an underscore, such as _AGE. Colours, linear, are COLOR_0,
// which a renderer multiplies the picture by: where the material has one they are _COLOR instead. With the UV
// sets of joints that blend it has none, since no material of glTF can mix them. A mesh without triangles
// becomes a node without mesh, as glTF has no empty ones.
void writeGlb(const ExportMesh& mesh, const Appearance& appearance, std::ostream& out);

}  // namespace fluidtex::tools
