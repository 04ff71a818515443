// What a mesh file holds, and what is wrong with one.
#pragma once

#include "sim/options.h"

#include <stdexcept>

namespace fluidtex::sim {

// Thrown by readMesh(), and by all that reads a mesh through it; names the file and what is wrong with it.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The points and polygons of an OBJ, PLY or STL file, in its order and with nothing repaired, but that all
// points are finite and all corners exist.
struct MeshSoup {
  std::vector<Vec3d> points;                       // #P, as in the file
  std::vector<std::vector<std::size_t>> polygons;  // corners of each
};
MeshSoup readSoup(const std::filesystem::path& file);

// Edges used by an odd number of polygons: where the surface has a rim.
std::size_t openEdges(const std::vector<std::vector<std::size_t>>& polygons);

// Throws that the file's mesh has a rim of so many edges.
[[noreturn]] void failOpen(const std::filesystem::path& file, std::size_t openEdges);

}  // namespace fluidtex::sim
