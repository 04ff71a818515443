#include "sim/pressure/slowed_sources.h"

#include "sim/grid/mac_grid.h"

#include <algorithm>

namespace fluidtex::sim {
namespace {

// A face through which liquid of given velocity comes into a cell.
struct Inlet {
  int cell;
  int at;  // the cell's place in the part
  int axis;
  Coord face;
  double flow;  // open area times speed
};

// The inlets of a part; empty where it reaches a stream side.
std::vector<Inlet> inletsOf(const std::vector<int>& part, const SolidField& solid,
                            const LiquidCells& liquid) {
  std::vector<Inlet> inlets;
  for (int at = 0; at < static_cast<int>(part.size()); ++at) {
    const int number = part[at];
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
      if (flow > 0.0) inlets.push_back({number, at, axis, face, flow});
    }
  }
  return inlets;
}

// Of what comes in through the inlets; 0 where there are none.
double shareOf(const std::vector<Inlet>& inlets, double flow) {
  double comesIn = 0.0;
  for (const Inlet& inlet : inlets) comesIn += inlet.flow;
  return comesIn > 0.0 ? flow / comesIn : 0.0;
}

}  // namespace

FaceGrids slowedSources(const SolidField& solid, const std::vector<std::vector<int>>& enclosed,
                        LiquidCells& liquid) {
  FaceGrids slowed = solid.given;
  bool copied = false;
  for (const std::vector<int>& part : enclosed) {
    double excess = 0.0;
    for (const int number : part) excess -= liquid.outflow[number];
    const std::vector<Inlet> inlets = inletsOf(part, solid, liquid);
    const double share = std::clamp(shareOf(inlets, excess), 0.0, 1.0);
    if (share <= 0.0) continue;
    if (!copied) {
      for (FloatGrid::Ptr& grid : slowed.component) grid = grid->deepCopy();
      copied = true;
    }
    for (const Inlet& inlet : inlets) {
      FloatTree& given = slowed.component[inlet.axis]->tree();
      given.setValueOn(inlet.face, static_cast<float>((1.0 - share) * given.getValue(inlet.face)));
      liquid.outflow[inlet.cell] += share * inlet.flow;
    }
  }
  return slowed;
}

void takeBack(const SolidField& solid, const std::vector<std::vector<int>>& enclosed,
              const std::vector<int>& liquidOf, const LiquidCells& liquid, std::vector<double>& outflow,
              FaceGrids& velocity) {
  for (const std::vector<int>& part : enclosed) {
    std::vector<int> cells;
    double wanted = 0.0;
    for (const int unknown : part) {
      cells.push_back(liquidOf[unknown]);
      wanted += outflow[unknown];
    }
    const std::vector<Inlet> inlets = inletsOf(cells, solid, liquid);
    const double share = std::clamp(shareOf(inlets, wanted), -1.0, 1.0);
    for (const Inlet& inlet : inlets) {
      const double speed = solid.given[inlet.axis].constTree().getValue(inlet.face);
      velocity.component[inlet.axis]->tree().setValueOn(inlet.face, static_cast<float>(-share * speed));
      outflow[part[inlet.at]] -= share * inlet.flow;
    }
  }
}

}  // namespace fluidtex::sim
