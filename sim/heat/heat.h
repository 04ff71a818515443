// Heat conduction in the liquid, and viscosity by temperature. Temperatures in kelvin at cell centres.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

namespace fluidtex::sim {

// Viscosity (Pa s) of a liquid at a temperature: `viscosity` at the law's reference temperature, changed by
// the law, or that of the law's table; at most the solid's, and the solid's below the solidus.
double viscosityAt(const ViscosityLaw& law, double viscosity, double temperature);

// The same for every value of a grid.
FloatGrid::Ptr viscosityOf(const FloatGrid& temperature, const ViscosityLaw& law, double viscosity);

// Conduction in the liquid, radiation from its surface (Stefan-Boltzmann law, against the surroundings) and
// loss to walls, for dt seconds.
// Implicit, with the conductance of radiation at the old temperature: stable for any dt, and no temperature
// leaves the range of the liquid, the walls and the surroundings. False where the solve does not converge.
[[nodiscard]] bool conductHeat(FloatGrid& temperature, const FloatGrid& phi, const SolidField& solid,
                               double dt, double density, const HeatOptions& heat);

}  // namespace fluidtex::sim
