// Values as they would stand in a scene file, for messages.
#pragma once

#include "scenes/visitor.h"

#include <string>
#include <vector>

namespace fluidtex::scenes {

std::string written(double value);
std::string written(const Vec3d& value);
std::string written(const std::vector<int>& value);

// "above 0", "0 or more", "from 8 to 4096"; empty where anything goes.
std::string rangeOf(const Limits& limits);

// Whether the value is inside. Values that are not finite are only where the limits say so.
bool within(const Limits& limits, double value);

}  // namespace fluidtex::scenes
