// Marker particles on both sides of the surface: the particle level set method of Enright, Fedkiw, Ferziger,
// Mitchell, "A hybrid particle level set method for improved interface capturing", 2002. Markers are carried
// by the flow and keep what the grid loses: edges, films, volume. Where one has come out on the wrong side of
// the surface, phi is in error and is put right by it.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// A sphere that touched the surface when it was last measured. In units of cells: x, y, z from the centre of
// the first cell of its block, each in [0, 8); radius 0.1 to 0.5, negative for a marker of the liquid.
struct Marker {
  float x, y, z, radius;
};

// The markers of one leaf of phi.
struct MarkerBlock {
  Coord origin{0};
  std::vector<Marker> markers;
};

// In the order of their origins, none empty.
using Markers = std::vector<MarkerBlock>;

// The block at that origin; null where there is none.
template <class Blocks>
auto findBlock(Blocks& markers, const Coord& origin) {
  const auto it =
      std::lower_bound(markers.begin(), markers.end(), origin,
                       [](const MarkerBlock& block, const Coord& at) { return block.origin < at; });
  return it != markers.end() && it->origin == origin ? &*it : nullptr;
}

// Markers for a surface: of the liquid and of the air, in every cell that the band reaches, none deep in
// solids. visibility: of the solids (SolidField), null for none that are thin.
Markers seedMarkers(const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed,
                    const Visibility* visibility = nullptr);

// The markers dt seconds later (give them away: there are too many to keep twice): third-order Runge-Kutta,
// velocity trilinear. Throws std::invalid_argument where dt max|u| / h is not below 5 (kMaxTrace).
// Markers of the air that the flow squeezes out between liquid and liquid are dropped, and those that come
// out on the other side of a thin solid. visibility: of the solids (SolidField), null for none that are thin.
Markers advectMarkers(Markers markers, const Velocity& velocity, double dt,
                      const Visibility* visibility = nullptr);

// Puts phi right at the corners of cells with escaped markers, those farther on the wrong side than their
// radius; at those that are on the marker's side of a thin solid.
void correctPhi(FloatGrid& phi, const Markers& markers, const Visibility* visibility = nullptr);

// Measures the radii anew; drops markers that have left the band, those in solids, and those of bubbles that
// have closed; and fills cells near the surface that have no more than half of what they should. `seed` must
// differ from call to call.
void maintainMarkers(Markers& markers, const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed,
                     const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
