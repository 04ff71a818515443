// What can be said of a scene before it runs: how much liquid is poured, where it can get to, and whether it
// is at rest. By samples, three to a cell along each axis, of the shapes themselves: no grid of the solver.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/solids.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace fluidtex::stress {

using sim::Coord;
using sim::Vec3d;

inline constexpr int kSamplesPerCell = 3;

// The cells of [0, size], and beyond sides that are unbounded those that liquid is put in, at most as far
// again.
openvdb::CoordBBox sampledCells(const sim::Options& options);

// What was found at the samples of these cells.
class Surroundings {
 public:
  // leaking: solids (by index) of which it is known that they do not hold liquid. They do not count, nor do
  // those that move, come or go.
  Surroundings(const sim::Options& options, const std::vector<std::size_t>& leaking);

  // Nothing moves the liquid: it fills all that it can get to below its highest place, in a domain and beside
  // solids that stay as they are. (Not known of liquid with surface tension, which may be out of shape.)
  bool atRest() const { return m_atRest; }

  // Whether there is an open way to a part of this cell from where liquid was poured or comes from; where it
  // is at rest, one that leads nowhere more than a cell above it.
  bool reached(const Coord& cell) const;

  // m3 of this shape in the open, as solids are at time t, where `alsoIn` is below 0 (metres, at world
  // positions).
  double volumeIn(const sim::Shape& shape, double t,
                  const std::function<double(const Vec3d&)>& alsoIn = {}) const;
  // m2 of its surface in the open.
  double surfaceOf(const sim::Shape& shape, double t) const;
  // m3/s that flow of this velocity takes out of the shape's surface in the open: of what the shape itself
  // would give, whatever cells make of it.
  double frontRate(const sim::Shape& shape, const Vec3d& velocity, double t) const;
  // Of all that is there at the start, and how large its surface is, m2.
  double pouredVolume() const { return m_poured; }
  double pouredSurface() const { return m_pouredSurface; }
  // m3 of it in cells with no corner in the open: gaps narrower than a cell, which the solver closes.
  double inNarrowGaps() const { return m_inNarrowGaps; }
  // m3 that cells may be wrong by in which a wall thinner than a cell stands beside liquid: half of each, as
  // a cell belongs to one side of a wall.
  double besideThinWalls() const { return m_besideThinWalls; }

  // m3 that a source (by index) can fill: of the open that its liquid can get to, as solids are at the start,
  // without what is poured or a source's at any time. Where walls divide the source, of the smallest part.
  // Infinite where liquid can get out of the domain through an unbounded side.
  double roomFor(std::size_t source) const { return m_rooms[source]; }

  // Most of -gravity . x, m2/s2, of what is poured or comes in until time t; -infinity where there is
  // nothing.
  double highest(double t) const;

 private:
  Vec3d place(std::size_t sample) const;
  std::vector<float> distances(const std::function<double(const Vec3d&)>& distance) const;
  void findUnresolved(const sim::Solids& solids, const std::vector<float>& open,
                      const std::vector<float>& liquid);
  // What liquid can get to in the open from where it is.
  struct Flood {
    std::vector<std::uint8_t> reached;
    bool unbounded = false;  // it can get out through an unbounded side
  };
  Flood flood(const std::vector<float>& open, const std::vector<float>& liquid, double highest,
              double near) const;
  bool isFilled(const std::vector<float>& open, const std::vector<float>& liquid,
                const std::function<double(const Vec3d&)>& toLiquid, double highest) const;
  double roomFrom(const std::vector<float>& open, const std::vector<float>& source,
                  const std::vector<float>& taken) const;

  const sim::Options& m_options;
  double m_step;           // from sample to sample, metres
  Coord m_first, m_count;  // of samples
  Flood m_flood;
  std::vector<double> m_rooms;  // of sources
  bool m_atRest = false;
  double m_poured = 0.0, m_pouredSurface = 0.0, m_inNarrowGaps = 0.0, m_besideThinWalls = 0.0;
  struct Body {
    double from, highest;
  };
  std::vector<Body> m_bodies;
};

}  // namespace fluidtex::stress
