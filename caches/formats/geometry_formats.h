// Readers of geometry formats, one a file.
#pragma once

#include "caches/formats/geometry.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace fluidtex::caches {

// What readGeometry() gives of a file of this name with these bytes, packed or not. Throws as it does.
Geometry geometryOf(const std::filesystem::path& file, std::string bytes);

// Each takes all of a file, unpacked, and no more memory than a multiple of that. Points may be infinite.
// Throws std::runtime_error; the message continues a sentence that begins with the file's name.

// Binary meshes of Blender (with normals), of FLIP Fluids (without), and its vectors (no triangles).
Geometry geometryOfBobj(std::string_view bytes);

// Legacy VTK files, 1.0 to 5.1, ASCII and BINARY, of POLYDATA and UNSTRUCTURED_GRID.
Geometry geometryOfVtk(std::string_view bytes);

// VTK XML files of PolyData: pieces one behind the other; arrays as text, in base64 or as they are, packed by
// zlib or not.
Geometry geometryOfVtp(std::string_view bytes);

// Houdini geometry of before version 12, which particle solvers still write by Partio: polygons and
// particles.
Geometry geometryOfBgeo(std::string_view bytes);

// OBJ, PLY and STL are read as shapes of solids are.
Geometry geometryOfObj(std::string_view bytes);
Geometry geometryOfPly(std::string_view bytes);
Geometry geometryOfStl(std::string_view bytes);

}  // namespace fluidtex::caches
