#include "scenes/value_text.h"

#include <cmath>
#include <sstream>

namespace fluidtex::scenes {

std::string written(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

std::string written(const Vec3d& value) {
  std::ostringstream text;
  text.precision(10);
  text << '[' << value[0] << ", " << value[1] << ", " << value[2] << ']';
  return text.str();
}

std::string written(const std::vector<int>& value) {
  std::ostringstream text;
  text << '[';
  for (std::size_t i = 0; i < value.size(); ++i) text << (i > 0 ? ", " : "") << value[i];
  text << ']';
  return text.str();
}

std::string rangeOf(const Limits& limits) {
  const bool low = std::isfinite(limits.low), high = std::isfinite(limits.high);
  if (low && high) {
    if (limits.aboveLow) return "above " + written(limits.low) + " and up to " + written(limits.high);
    return "from " + written(limits.low) + " to " + written(limits.high);
  }
  if (low) return limits.aboveLow ? "above " + written(limits.low) : written(limits.low) + " or more";
  return high ? "up to " + written(limits.high) : "";
}

bool within(const Limits& limits, double value) {
  if (!std::isfinite(value)) return limits.infinite && value > 0.0;
  return (limits.aboveLow ? value > limits.low : value >= limits.low) && value <= limits.high;
}

}  // namespace fluidtex::scenes
