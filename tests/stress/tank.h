// A tank of liquid, with what stands in it.
#pragma once

#include "sim/options.h"

#include <string>
#include <utility>

namespace fluidtex::stress {

using sim::Vec3d;

inline sim::Shape boxShape(const Vec3d& low, const Vec3d& high) {
  return {sim::Box{low, high}};
}

// A tank of 20 cells a side.
inline sim::Options tank(sim::Shape liquid) {
  sim::Options options;
  options.resolution = 20;
  options.liquid.push_back({std::move(liquid)});
  return options;
}

inline void addSolid(sim::Options& options, sim::Shape shape) {
  sim::Solid solid;
  solid.name = std::to_string(options.solids.size());
  solid.shape = std::move(shape);
  options.solids.push_back(solid);
}

}  // namespace fluidtex::stress
