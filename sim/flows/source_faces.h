// The velocities that sources give at the faces of the grid.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <array>
#include <functional>

namespace fluidtex::sim {

// A source on the grid.
struct SourceGrids {
  FloatGrid::Ptr phi;        // signed distance, metres: the cells that are kept full
  Vec3d speed{0.0};          // m/s
  double temperature = 0.0;  // K
  double mixture = 0.0;
  std::array<FloatGrid::Ptr, 3>
      velocity{};  // active at all faces of the cells whose centre it holds; null where it only keeps full
  std::function<double(const Vec3d&)> distance = {};  // signed, metres, at any place
};

// Whether a cell is the source's: its centre is or, where that lies in a solid, the middle of the cell's open
// part.
bool isInSource(const SourceGrids& source, const SolidField& solid, const Coord& cell);

// Velocities given at faces, m/s; active where one is given.
struct GivenFaces {
  std::array<FloatGrid::Ptr, 3> grid;

  void set(int axis, const Coord& face, float speed) { grid[axis]->tree().setValueOn(face, speed); }
};

// The velocities of a source, m/s, at all faces of the domain's cells whose centre lies in it. Its back is
// closed: under water, what leaves at the front would enter there. phi: its signed distance.
std::array<FloatGrid::Ptr, 3> sourceFaces(const FloatGrid& phi, const Vec3d& velocity,
                                          const CoordBBox& domain);

// Adds what a source with a velocity gives, times a factor, at its faces that solids leave open, and in the
// slivers of cells at solids that it fills or all but touches.
void giveSource(GivenFaces& given, const SourceGrids& source, double factor, const SolidField& solid);

}  // namespace fluidtex::sim
