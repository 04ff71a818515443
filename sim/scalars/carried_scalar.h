// Scalars that move with the liquid, at cell centres: temperature, mixture.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solid_layers.h"
#include "sim/solids/solids.h"

#include <functional>

namespace fluidtex::sim {

// Layers of cells beyond the liquid to which its scalars are extrapolated: newly wet cells of a step lie
// within.
inline constexpr int kScalarLayers = 6;

// Whether a cell holds a value of its own. phi, solidDistance: metres, at its centre; h: its width.
inline bool isLiquidCell(float phi, float solidDistance, float h) {
  return phi < 0.0f && solidDistance >= -kDeepInSolid * h;
}

// A grid with full leaves where `like` has leaves: values of `from` where it has that leaf, else its
// background.
FloatGrid::Ptr makeScalar(const FloatGrid& from, const FloatTree& like);
// The same without values to start from: all at `background`.
FloatGrid::Ptr makeScalar(double h, double background);

// Sets the cells within half a cell of a body, distance(x) < 0.
void setInBody(FloatGrid& scalar, const std::function<double(const Vec3d&)>& distance, double value);

// Extrapolates the scalar, constant, from the liquid's cells into air and solids, for `layers` cells.
void extendScalar(FloatGrid& scalar, const FloatGrid& phi, const FloatGrid& solidPhi, int layers,
                  const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
