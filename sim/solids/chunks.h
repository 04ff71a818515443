// Chunks: cubes of 32 x 32 x 32 cells, by which what surrounds the liquid follows it. Each is known by its
// lowest cell, whose coordinates are multiples of 32.
#pragma once

#include "sim/grid/grids.h"

#include <vector>

namespace fluidtex::sim {

using openvdb::Coord;
using openvdb::CoordBBox;

inline constexpr int kChunkDim = 32;

// In order, each once.
using Chunks = std::vector<Coord>;

// Those that touch the box.
Chunks chunksIn(const CoordBBox& box);

// Those that touch the box and lie no more than `reach` chunks from one that holds liquid of one of the phis,
// or its band.
Chunks chunksAround(const std::vector<const FloatGrid*>& phis, int reach, const CoordBBox& box);

// Those of both lists.
Chunks united(Chunks a, const Chunks& b);

// Whether all of `some` are among `all`.
bool covers(const Chunks& all, const Chunks& some);

}  // namespace fluidtex::sim
