// Reading of the meshes and particles that other liquid programs write.
#pragma once

#include "caches/formats/format_error.h"
#include "caches/formats/geometry.h"

#include <filesystem>

namespace fluidtex::caches {

// Whether readGeometry() reads files of this name, by its ending, in letters of either case: .ply .obj .stl
// .vtp .vtk .bobj .bgeo, each also with .gz behind it. Looks at no file.
bool isGeometryFile(const std::filesystem::path& file);

// For files of formats that are known and not read (.abc, .bgeo.sc, .usd, .aur, .bif, .sim, ...), by their
// ending: half a sentence that says how their programs write what is read. Empty for all others.
std::string adviceFor(const std::filesystem::path& file);

// The points, triangles and attributes at points of a file. May be packed by gzip, whatever its name.
//   Polygons of any size and triangle strips become triangles; vertices and lines count nowhere.
//   Points that no triangle uses stay. Triangles may be degenerate. A file without points is an empty frame.
//   STL has three points of its own for each facet.
//   Attributes are those of .ply, .vtk, .vtp and .bgeo; text attributes are left out. In PLY each property is
// one number: three whose names are the same but for x, y, z at the end ("vx vy vz", "velocity_x velocity_y
// velocity_z") become one attribute of three components by what is the same ("v", "velocity"), provided that
// something is, and no other property bears that name; each other property is an attribute of its own.
//   In .bobj nothing has a name: normals of Blender's are passed over. FLIP Fluids' velocity######.bobj is
// read as points; see flip_fluids.h.
// Memory stays within a multiple of the file's size, or of its size unpacked, whatever it claims.
// Throws FormatError: missing, of another format (with adviceFor() it), damaged, a point that is not finite
// in single precision, a corner that is no point.
Geometry readGeometry(const std::filesystem::path& file);

}  // namespace fluidtex::caches
