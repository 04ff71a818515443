// Settings of the solver: the liquid and its surroundings as a scene file gives them.
// Units are SI; Z is up; right-handed. Positions are in world space. The domain is [0, size], and extends
// beyond it on unbounded sides.
#pragma once

#include "sim/shape.h"
#include "sim/vec3.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace fluidtex::sim {

inline constexpr double kForever = std::numeric_limits<double>::infinity();

// Liquid that is poured into the domain at time `from` (seconds), outside solids.
struct LiquidBody {
  Shape shape;
  Vec3d velocity{0.0};  // m/s
  double from = 0.0;
  double temperature = 293.15;  // K
  double mixture = 0.0;         // 0 to 1, see Options::mixes
};

enum class WallKind { slip, noSlip, friction };

// Tangential boundary condition at a solid's surface. It acts through viscosity: a liquid whose viscosity is
// negligible on the grid slips along all walls.
struct Wall {
  WallKind kind = WallKind::slip;
  // Navier's slip length with friction, metres: the depth behind the surface at which the tangential
  // velocity, extrapolated linearly from the liquid, equals the wall's. 0 is no slip, infinity free slip.
  double slipLength = 0.01;
  Vec3d velocity{0.0};  // m/s, of the surface, tangential (a belt, a driven lid)
};

// Which of the domain's faces.
enum class DomainFace { all, xLow, xHigh, yLow, yHigh, zLow, zHigh };

struct DomainWall {
  DomainFace face = DomainFace::all;
  Wall wall;
};

// A measured viscosity (Pa s) at a temperature (K).
struct ViscosityPoint {
  double temperature = 0.0, viscosity = 0.0;
};

// How viscosity depends on temperature (K). Options::viscosity is that at `reference`.
struct ViscosityLaw {
  enum class Kind { constant, exponential, arrhenius, table };
  Kind kind = Kind::constant;
  double reference = 1400.0;           // K
  double slope = 0.04;                 // 1/K, exponential: viscosity exp(-slope (T - reference))
  double activationEnergy = 200000.0;  // J/mol, Arrhenius: viscosity exp(E / R (1/T - 1/reference))
  // table, in place of Options::viscosity: by rising temperature. The logarithm of viscosity is linear
  // between the points and constant beyond the first and the last.
  std::vector<ViscosityPoint> points{};
  double solidus = 0.0;         // K, solid below
  double solidViscosity = 1e6;  // Pa s, of the solid; the law exceeds it only as far as `viscosity` does
};

struct HeatOptions {
  bool simulated = false;
  double capacity = 1200.0;         // J/(kg K)
  double conductivity = 1.5;        // W/(m K)
  double emissivity = 0.0;          // 0 to 1, of the surface
  double ambient = 293.15;          // K, of the surroundings
  double wallTransfer = 0.0;        // W/(m2 K), to walls
  double wallTemperature = 293.15;  // K
  ViscosityLaw law;
};

// Position of a moving solid at a time: moved by `move` (metres) and turned by `turn` degrees about its axis.
struct Keyframe {
  double time = 0.0;  // s
  Vec3d move{0.0};
  double turn = 0.0;
};

// A solid that exists for from <= t < until (seconds). With keyframes it moves at constant rates from one to
// the next; before the first and after the last it is at rest. A MeshSequence that also has keyframes is
// first deformed, then moved.
struct Solid {
  std::string name;
  Shape shape;
  double from = 0.0, until = kForever;
  Wall wall;
  bool visible = true;
  Vec3d color{0.5, 0.5, 0.5};             // linear RGB, how it is drawn where visible
  std::vector<Keyframe> keyframes;        // in the order of time
  Vec3d pivot{0.0}, axis{0.0, 0.0, 1.0};  // a point on the axis it turns about, and its direction
};

struct RatePoint {
  double time = 0.0, factor = 1.0;
};

// An inflow region for from <= t < until. It is kept full, and liquid flows through the faces of its cells
// with `velocity` times a factor, which is linear between the points of `rate` and 1 without any. With
// velocity 0 it is only kept full.
struct Source {
  Shape shape;
  Vec3d velocity{0.0};          // m/s
  double temperature = 293.15;  // K, of the liquid that comes
  double mixture = 0.0;         // 0 to 1, of the liquid that comes
  double from = 0.0, until = kForever;
  std::vector<RatePoint> rate;  // in the order of time
};

// A region that removes all liquid in it for from <= t < until.
struct Drain {
  Shape shape;
  double from = 0.0, until = kForever;
};

// Kinds of the domain's sides. wall: solid. open: an edge that liquid falls off, with no pressure beyond and
// no inflow. stream: a cut through a stream that continues beyond, so that waves pass through. symmetry: a
// plane beyond which everything is its mirror image; liquid slips along it and never separates. unbounded: no
// side; the domain extends as far as liquid gets.
enum class Side { wall, open, stream, symmetry, unbounded };

// Whether nothing passes through the side.
inline bool isClosed(Side side) {
  return side == Side::wall || side == Side::symmetry;
}

struct Options {
  Vec3d size{1.0};  // of the domain, metres; on unbounded sides, where it would end
  // Its faces: at low x, high x, low y, high y, low z, high z.
  std::array<Side, 6> sides{};
  int resolution = 64;  // cells along the longest side of [0, size]
  Vec3d gravity{0.0, 0.0, -9.81};
  double density = 1000.0;      // kg/m3
  double viscosity = 0.001;     // Pa s
  double surfaceTension = 0.0;  // N/m, of water 0.072
  HeatOptions heat;
  std::vector<DomainWall> walls;  // other than free slip; of several for one face, the last
  double cfl = 3.0;               // a substep moves nothing further than this many cells
  double frameRate = 24.0;        // frames a second
  std::vector<LiquidBody> liquid;
  std::vector<Solid> solids;
  std::vector<Source> sources;
  std::vector<Drain> drains;
  std::uint64_t seed = 1;  // of the scene: places of markers

  // The wall of a side, in the order of `sides`.
  Wall wallOf(int side) const {
    Wall wall;
    for (const DomainWall& given : walls) {
      if (given.face == DomainFace::all || int(given.face) == side + 1) wall = given.wall;
    }
    return wall;
  }

  // Whether its liquids differ in `mixture`, a number that moves with the liquid and does nothing else: it
  // tells which of them a place holds, or how they are mixed.
  bool mixes() const {
    const auto mixed = [](const auto& part) { return part.mixture != 0.0; };
    return std::any_of(liquid.begin(), liquid.end(), mixed) ||
           std::any_of(sources.begin(), sources.end(), mixed);
  }

  double voxelSize() const { return std::max({size.x(), size.y(), size.z()}) / resolution; }
};

}  // namespace fluidtex::sim
