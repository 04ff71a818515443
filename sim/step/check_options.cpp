#include "sim/step/check_options.h"

#include "sim/grid/require.h"

#include <cmath>

namespace fluidtex::sim {
namespace {

bool isPositive(double x) {
  return x > 0.0 && std::isfinite(x);
}

bool isNotNegative(double x) {
  return x >= 0.0 && std::isfinite(x);
}

}  // namespace

const Options& checked(const Options& options) {
  require(isPositive(options.size[0]) && isPositive(options.size[1]) && isPositive(options.size[2]),
          "the domain's size must be positive");
  require(options.resolution >= 1, "the resolution must be at least one cell");
  require(isPositive(options.density), "the density must be positive");
  require(isNotNegative(options.viscosity), "the viscosity must not be negative");
  require(isNotNegative(options.surfaceTension), "the surface tension must not be negative");
  require(std::isfinite(options.gravity.length()), "gravity must be finite");
  require(isPositive(options.cfl), "the CFL number must be positive");
  require(isPositive(options.frameRate), "the frame rate must be positive");
  if (options.heat.simulated) {
    require(isPositive(options.heat.capacity), "the heat capacity must be positive");
    require(isNotNegative(options.heat.conductivity) && isNotNegative(options.heat.emissivity) &&
                isNotNegative(options.heat.wallTransfer),
            "conductivity, emissivity and the walls' heat transfer must not be negative");
    require(isNotNegative(options.heat.ambient) && isNotNegative(options.heat.wallTemperature),
            "temperatures must not be below 0 K");
  }
  return options;
}

}  // namespace fluidtex::sim
