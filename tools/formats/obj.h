// Wavefront OBJ and MTL (Alias Wavefront, Object Files and Material Library files).
#pragma once

#include "tools/formats/appearance.h"
#include "tools/formats/export_mesh.h"

#include <iosfwd>

namespace fluidtex::tools {

// The name of the material file beside the frames', the same for all of them; of an exemplar that moves each
// has its own.
inline constexpr const char* kObjMaterials = "surface.mtl";
std::string objMaterials(const Appearance& appearance, int frame);

// Writes the text of an .obj: positions with colours (sRGB), normals, the UV set `st` of a mesh whose joints
// are cut. Y up, as most readers take it: (x, y, z) is written as (x, z, -y). Other columns have no place in
// the format.
void writeObj(const ExportMesh& mesh, const Appearance& appearance, std::ostream& out);

// The text of the material file.
std::string mtlOf(const Appearance& appearance);

}  // namespace fluidtex::tools
