// Markers that are alone on the wrong side of the surface.
//
// A marker that has escaped pulls the surface to itself in every step. Where the grid has lost an edge, a
// film or a thread, all markers there have escaped together, and bring it back. A stray one has markers of
// the other side between itself and the surface: it stands for a bubble or a drop far below a cell, which the
// grid cannot show, and pits the surface for good.
#pragma once

#include "sim/grid/block_samples.h"
#include "sim/markers/markers.h"

#include <cstdint>
#include <vector>

namespace fluidtex::sim {

// Cells around a block that mayBeStray() reads.
inline constexpr int kStrayHalo = 3;

// Whether a marker that has escaped may be stray: by less than a cell, from a body of its own side that is a
// cell deep or more. phi: at the marker; distance: phi around its block; both in cells.
bool mayBeStray(const Marker& m, float phi, const BlockSamples& distance);

// Of one block.
struct Suspects {
  std::vector<std::uint32_t> marker;  // indices of those that may be stray, ascending
  std::size_t voters = 0;             // the block's first markers, which have moved with the flow
};

// Drops the suspects for whose place few markers speak, and more than twice as many of the other side against
// it: those within a cell of the suspect that are no farther from the surface. Leaves `suspects` with those
// dropped; blocks may be left empty.
// suspects: of each block. phi: metres.
void dropOutvoted(Markers& markers, std::vector<Suspects>& suspects, const FloatGrid& phi);

}  // namespace fluidtex::sim
