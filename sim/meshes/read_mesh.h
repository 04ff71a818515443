// Reading and checking of mesh files.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/options.h"

#include <stdexcept>

namespace fluidtex::sim {

// Thrown by readMesh() and by its callers; names the file and what is wrong with it.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The points and polygons of an OBJ, PLY or STL file, in its order and without repair. All points are finite,
// all corners exist and all polygons have three or more. An STL has three points of its own for each facet.
// Memory stays within a multiple of the file's size, whatever it holds. Throws MeshError.
struct MeshSoup {
  std::vector<Vec3d> points;                       // #P, as in the file
  std::vector<std::vector<std::size_t>> polygons;  // corners of each
};
MeshSoup readSoup(const std::filesystem::path& file);

// Where the corners of a soup's polygons lie in a picture: u to the right, v up from the lowest row, 0..1
// over the picture.
struct SoupUv {
  static constexpr std::size_t kNone = ~std::size_t(0);
  std::vector<openvdb::Vec2d> places;
  std::vector<std::vector<std::size_t>> corners;  // for each polygon's, into `places`; kNone: has none
};
// The same of an OBJ, with its texture coordinates (vt).
MeshSoup readSoup(const std::filesystem::path& file, SoupUv& uv);

// A file's points in the world, metres. Throws MeshError where they exceed single precision.
std::vector<openvdb::Vec3f> placedPoints(const std::filesystem::path& file, const MeshSoup& soup,
                                         const MeshPlace& place);

// Throws MeshError where the file's polygons do not form a closed surface.
void checkClosed(const std::filesystem::path& file, const std::vector<std::vector<std::size_t>>& polygons);

// turnedOutward(); throws MeshError where the file's surface is one-sided.
std::vector<openvdb::Vec3I> outwardTriangles(const std::filesystem::path& file, const TriangleMesh& mesh);

// Reads OBJ, PLY or STL: polygons split into triangles, all turned outward whatever their orientation in the
// file. A closed surface within another one is the wall of a cavity; parts that cross or touch are one solid.
// Throws MeshError, which names the file and what is wrong (missing, unreadable, no faces, not closed).
TriangleMesh readMesh(const MeshShape& shape);

}  // namespace fluidtex::sim
