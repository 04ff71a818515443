// What a cache's liquid has besides surface and velocity: temperature, age, colour.
#pragma once

#include "caches/formats/geometry.h"
#include "caches/liquid/cache.h"
#include "caches/liquid/closest_triangles.h"

#include <map>
#include <string>

namespace fluidtex::caches {

// Layout::fields of a frame as grids in the world's place, active around the surface; vectors as three grids
// (scalarNames()), in the axes of the files. Attributes at points are continued off a mesh, and interpolated
// between particles. A field that this frame's file lacks is left out, and so are values that are no number.
// geometry: of the surface's file, empty where that holds grids. closest: triangles of the surface, placed.
// spacing: between particles, in the file's unit.
// Throws FormatError or foreign::Unreadable for files that cannot be read.
std::map<std::string, sim::FloatGrid::ConstPtr> furtherFields(const Cache& cache, int number,
                                                              const Geometry& geometry,
                                                              ClosestTriangles& closest, double spacing);

}  // namespace fluidtex::caches
