// What a geometry file of another program holds.
#pragma once

#include <openvdb/Types.h>

#include <map>
#include <string>
#include <vector>

namespace fluidtex::caches {

struct Attribute {
  int components = 1;
  std::vector<float> values;  // #P x components, row by row; integers become the nearest float
};

struct Geometry {
  std::vector<openvdb::Vec3f> points;           // #P, as in the file: in its own unit and axes, all finite
  std::vector<openvdb::Vec3I> triangles;        // #T x 3 points, turned as in the file; none: particles
  std::map<std::string, Attribute> attributes;  // at points, by their names in the file
};

}  // namespace fluidtex::caches
