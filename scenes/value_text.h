// Text of values and of their limits, for messages; as in a scene file.
#pragma once

#include "scenes/visitor.h"

#include <string>
#include <vector>

namespace fluidtex::scenes {

std::string written(double value);
std::string written(const Vec3d& value);
std::string written(const std::vector<int>& value);

// "above 0", "0 or more", "from 8 to 4096"; empty without limits.
std::string rangeOf(const Limits& limits);

// Whether the value is within the limits. Not finite values only are if the limits say so.
bool within(const Limits& limits, double value);

}  // namespace fluidtex::scenes
