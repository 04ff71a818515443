// Cleans the faces of a mesh file, to polygons that bound a solid.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/vec3.h"

#include <vector>

namespace fluidtex::sim {

using Polygons = std::vector<std::vector<std::size_t>>;  // the corners of each, by number

// A polygon's corners without those equal to the one before.
std::vector<std::size_t> withoutRepeats(const std::vector<std::size_t>& polygon);

// Numbers of edges used by an odd number of polygons: by one, where the surface has a rim; by three or more,
// where a face meets it from inside.
struct OpenEdges {
  std::size_t ofOne = 0, ofMore = 0;
  bool none() const { return ofOne + ofMore == 0; }
};
OpenEdges openEdges(const Polygons& polygons);

// Removes duplicates of faces with the same corners. Three rules are tried until the surface is closed:
// groups whose faces cancel in orientation (a wall within the solid, as of cubes side by side) are removed;
// one face of every group is kept; groups of even size are removed. Of the other groups one face is kept.
// Where no rule closes it, the faces are returned unchanged.
Polygons withoutTwins(const Polygons& polygons);

// The corner from which a polygon is best split into a fan: the one whose triangles agree most with the
// polygon's normal. isWhole: all of them agree, as for any corner of a convex polygon. x: places of the
// corners.
struct Fan {
  std::size_t start = 0;
  bool isWhole = false;
};
Fan bestFan(const std::vector<Vec3d>& x);

}  // namespace fluidtex::sim
