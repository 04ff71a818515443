// Heat conduction in the liquid, and viscosity by temperature. Temperatures in kelvin at cell centres.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Viscosity (Pa s) of a liquid at a temperature: `viscosity` at the law's reference temperature, changed by
// the law, or that of the law's table; at most the solid's, and the solid's below the solidus.
double viscosityAt(const ViscosityLaw& law, double viscosity, double temperature);

// The same for every value of a grid.
FloatGrid::Ptr viscosityOf(const FloatGrid& temperature, const ViscosityLaw& law, double viscosity);

// A grid of temperatures with full leaves where `like` has leaves: values of `from` where it has that leaf,
// else its background.
FloatGrid::Ptr makeTemperature(const FloatGrid& from, const FloatTree& like);
// The same without values to start from: all at `background`.
FloatGrid::Ptr makeTemperature(double h, double background);

// Sets the cells within half a cell of a body, distance(x) < 0.
void heatBody(FloatGrid& temperature, const std::function<double(const Vec3d&)>& distance, double value);

// Extrapolates temperature, constant, from the liquid's cells into air and solids, for `layers` cells.
void extendTemperature(FloatGrid& temperature, const FloatGrid& phi, const FloatGrid& solidPhi, int layers,
                       const Visibility* visibility = nullptr);

// Conduction in the liquid, radiation from its surface (Stefan-Boltzmann law, against the surroundings) and
// loss to walls, for dt seconds.
// Implicit, with the conductance of radiation at the old temperature: stable for any dt, and no temperature
// leaves the range of the liquid, the walls and the surroundings. False where the solve does not converge.
[[nodiscard]] bool conductHeat(FloatGrid& temperature, const FloatGrid& phi, const SolidField& solid,
                               double dt, double density, const HeatOptions& heat);

}  // namespace fluidtex::sim
