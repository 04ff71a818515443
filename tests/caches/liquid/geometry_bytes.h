// Files of meshes and particles, as bytes.
#pragma once

#include "tests/caches/formats/written_bytes.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace fluidtex::caches {

// All numbers in a row.
std::vector<double> numbersOf(const std::vector<openvdb::Vec3d>& vectors, double factor = 1.0);

// Behind their number, four bytes.
std::string withCount(std::size_t count, const std::string& bytes);

// Blender's and FLIP Fluids' binary mesh; normals are Blender's.
std::string bobjBytes(const std::vector<openvdb::Vec3d>& points, const std::vector<openvdb::Vec3I>& triangles,
                      bool normals);

// Particles with a velocity, as SPlisHSPlasH writes them.
std::string vtkBytes(const std::vector<openvdb::Vec3d>& points,
                     const std::vector<openvdb::Vec3d>& velocities);

// Binary; without velocities where there are none.
std::string plyBytes(const std::vector<openvdb::Vec3d>& points, const std::vector<openvdb::Vec3I>& triangles,
                     const std::vector<openvdb::Vec3d>& velocities);

}  // namespace fluidtex::caches
