// Marker particles on both sides of the surface: the particle level set method of Enright, Fedkiw, Ferziger,
// Mitchell, "A hybrid particle level set method for improved interface capturing", 2002. Markers are advected
// with the flow and keep what the grid loses: edges, films, volume. Where one has escaped to the wrong side
// of the surface, it corrects phi.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/visibility.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// A sphere that touched the surface when its radius was last set. In units of cells: x, y, z from the centre
// of the first cell of its block, each in [0, 8); radius 0.1 to 0.5, negative for a liquid marker.
struct Marker {
  float x, y, z, radius;
};

// The markers of one leaf of phi.
struct MarkerBlock {
  Coord origin{0};
  std::vector<Marker> markers;
};

// Sorted by origin, none empty.
using Markers = std::vector<MarkerBlock>;

// The block at that origin; null where there is none.
template <class Blocks>
auto findBlock(Blocks& markers, const Coord& origin) {
  const auto it =
      std::lower_bound(markers.begin(), markers.end(), origin,
                       [](const MarkerBlock& block, const Coord& at) { return block.origin < at; });
  return it != markers.end() && it->origin == origin ? &*it : nullptr;
}

// Liquid and air markers for a surface, in every cell that the markers' band reaches, none deep in solids.
// visibility: of the solids (SolidField), null where none is thin.
Markers seedMarkers(const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed,
                    const Visibility* visibility = nullptr);

// The markers dt seconds later: third-order Runge-Kutta, velocity trilinear. Move the markers in: there are
// too many to copy.
// Dropped: air markers that the flow squeezes out between liquid and liquid, and markers that come out on the
// other side of a thin solid. visibility: of the solids (SolidField), null where none is thin.
// Throws std::invalid_argument where dt max|u| / h is not below 5 (kMaxTrace).
Markers advectMarkers(Markers markers, const Velocity& velocity, double dt,
                      const Visibility* visibility = nullptr);

// Corrects phi at the corners of cells with escaped markers, those farther on the wrong side than their
// radius; only at corners on the marker's side of a thin solid, and none deep in solids, where phi is
// extrapolated. Markers in solids correct nothing: there they move with what is extrapolated, too.
void correctPhi(FloatGrid& phi, const Markers& markers, const FloatGrid& solidPhi,
                const Visibility* visibility = nullptr);

// Updates the radii; drops markers that have left the band, those in solids, those of bubbles that have
// closed, and stray ones (sim/markers/stray_markers.h) away from thin solids; reseeds cells near the surface
// that have no more than half of their markers. `seed` must differ from call to call.
void maintainMarkers(Markers& markers, const FloatGrid& phi, const FloatGrid& solidPhi, std::uint64_t seed,
                     const Visibility* visibility = nullptr);

}  // namespace fluidtex::sim
