// Numbers in sentences.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>

namespace fluidtex::tools {

// A number that is known roughly, with two digits, and zeros behind them: "0.25", "4.8", "480", "130000".
// value: not negative.
inline std::string twoDigits(double value) {
  if (!(value >= 10.0)) return fmt::format("{:.2g}", value);
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return fmt::format("{:.0f}", unit * std::round(value / unit));
}

}  // namespace fluidtex::tools
