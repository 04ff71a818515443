// Reading of the meshes and particles that other liquid programs write.
#pragma once

#include "caches/formats/format_error.h"
#include "caches/formats/geometry.h"

#include <filesystem>

namespace fluidtex::caches {

// Whether readGeometry() reads files of this name, by its ending, in letters of either case: .ply .obj .stl
// .vtp .vtk .bobj .bgeo .bhclassic, each also with .gz behind it. Looks at no file.
bool isGeometryFile(const std::filesystem::path& file);

// Of formats that are known and not read (.abc, .bgeo.sc, .usd, .aur, .bif, .sim, .vtu, ...), by the ending:
// what it is, and how its program writes what is read. Empty for all others.
std::string adviceFor(const std::filesystem::path& file);

// The points, triangles and attributes at points of a file, packed by gzip or not.
//   Polygons of any size and triangle strips become triangles; vertices and lines count nowhere.
//   Points that no triangle uses stay. Triangles may be degenerate. A file without points is an empty frame.
//   STL has three points of its own for each facet.
//   Attributes are those at points of .ply, .vtk, .vtp and .bgeo; texts are left out, and values may be NaN.
//   In PLY each property is one number. Three whose names are the same but for x, y, z at the end become one
// attribute of three components, by what is before that and before a '_' or '.': "vx vy vz" are "v",
// "velocity_x velocity_y velocity_z" are "velocity". Another property of that name gets a '_' behind it.
//   In .bobj nothing has a name: normals of Blender's are left out. FLIP Fluids' velocity######.bobj is read
// as points; see flip_fluids.h.
// Memory stays within a multiple of the file's size, or of its size unpacked, whatever it claims.
// Throws FormatError: missing, of another format (adviceFor()), damaged, a point that is not finite in single
// precision, a corner that is no point.
Geometry readGeometry(const std::filesystem::path& file);

}  // namespace fluidtex::caches
