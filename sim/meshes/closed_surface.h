// From the faces of a mesh file to polygons that bound a solid.
#pragma once

#include "sim/meshes/triangle_mesh.h"
#include "sim/vec3.h"

#include <vector>

namespace fluidtex::sim {

using Polygons = std::vector<std::vector<std::size_t>>;  // the corners of each, by number

// Its corners without those that are the same as the one before.
std::vector<std::size_t> withoutRepeats(const std::vector<std::size_t>& polygon);

// Edges used by an odd number of polygons: by one, where the surface has a rim; by three or more, where a
// face meets it from inside.
struct OpenEdges {
  std::size_t ofOne = 0, ofMore = 0;
  bool none() const { return ofOne + ofMore == 0; }
};
OpenEdges openEdges(const Polygons& polygons);

// Faces that join the same corners, once: two that face each other, as of cubes side by side, are a wall
// within the solid and go; of others one is left. Of what closes the surface, that which takes least away;
// the faces as they are where nothing does.
Polygons withoutTwins(const Polygons& polygons);

// The corner from which a polygon is best cut into a fan: that whose triangles face its way most; isWhole:
// all of them do, as of any corner of a convex one. x: where its corners are.
struct Fan {
  std::size_t start = 0;
  bool isWhole = false;
};
Fan bestFan(const std::vector<Vec3d>& x);

}  // namespace fluidtex::sim
