#include "sim/pressure/slowed_sources.h"

#include "sim/grid/mac_grid.h"

#include <algorithm>

namespace fluidtex::sim {
namespace {

// A face through which liquid of given velocity comes into a cell.
struct Inlet {
  int cell;
  int axis;
  Coord face;
  double flow;  // open area times speed
};

// The inlets of a part; empty where it reaches a stream side.
std::vector<Inlet> inletsOf(const std::vector<int>& part, const SolidField& solid,
                            const LiquidCells& liquid) {
  std::vector<Inlet> inlets;
  for (const int number : part) {
    const LiquidSides& cell = liquid.sidesOf(number);
    const Coord place = liquid.numbering.cell(number);
    for (int s = 0; s < kSides; ++s) {
      if (cell.open[s] > 0.0f) continue;
      const int axis = s / 2;
      const Coord face = s % 2 == 0 ? place : neighborOf(place, s);
      const FloatTree& given = solid.given[axis].constTree();
      if (!given.isValueOn(face)) continue;
      if (endsAt(Side::stream, solid, place, s)) return {};
      const double speed = given.getValue(face), inward = s % 2 == 0 ? speed : -speed;
      const double flow = solid.open[axis].constTree().getValue(face) * inward;
      if (flow > 0.0) inlets.push_back({number, axis, face, flow});
    }
  }
  return inlets;
}

}  // namespace

FaceGrids slowedSources(const SolidField& solid, const std::vector<std::vector<int>>& enclosed,
                        LiquidCells& liquid) {
  FaceGrids slowed = solid.given;
  bool copied = false;
  for (const std::vector<int>& part : enclosed) {
    const std::vector<Inlet> inlets = inletsOf(part, solid, liquid);
    double comesIn = 0.0, excess = 0.0;
    for (const Inlet& inlet : inlets) comesIn += inlet.flow;
    if (comesIn <= 0.0) continue;
    for (const int number : part) excess -= liquid.outflow[number];
    const double share = std::clamp(excess / comesIn, 0.0, 1.0);
    if (share <= 0.0) continue;
    if (!copied) {
      for (FloatGrid::Ptr& grid : slowed.component) grid = grid->deepCopy();
      copied = true;
    }
    for (const auto& [number, axis, face, flow] : inlets) {
      FloatTree& given = slowed.component[axis]->tree();
      given.setValueOn(face, static_cast<float>((1.0 - share) * given.getValue(face)));
      liquid.outflow[number] += share * flow;
    }
  }
  return slowed;
}

}  // namespace fluidtex::sim
