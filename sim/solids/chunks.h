// Chunks: cubes of 32 x 32 x 32 cells in which data around the liquid is made as the liquid moves. A chunk is
// named by its lowest cell, whose coordinates are multiples of 32.
#pragma once

#include "sim/grid/grids.h"

#include <vector>

namespace fluidtex::sim {

using openvdb::Coord;
using openvdb::CoordBBox;

inline constexpr int kChunkDim = 32;

// Sorted, without duplicates.
using Chunks = std::vector<Coord>;

// Chunks that touch the box.
Chunks chunksIn(const CoordBBox& box);

// Chunks that touch the box and lie at most `reach` chunks from one that holds liquid of one of the phis, or
// its narrow band.
Chunks chunksAround(const std::vector<const FloatGrid*>& phis, int reach, const CoordBBox& box);

// Union of both lists.
Chunks united(Chunks a, const Chunks& b);

// Whether all of `some` are among `all`.
bool covers(const Chunks& all, const Chunks& some);

}  // namespace fluidtex::sim
