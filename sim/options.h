// Settings of the solver: what a scene file says about the liquid and its surroundings.
// Units are SI; Z is up; right-handed. Positions are in world space, the domain is [0, size].
#pragma once

#include <openvdb/math/Vec3.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <variant>
#include <vector>

namespace fluidtex::sim {

using Vec3d = openvdb::math::Vec3<double>;

struct Box {
  Vec3d min{0.0}, max{1.0};
};

struct Sphere {
  Vec3d center{0.0};
  double radius = 1.0;
};

// Everything behind the plane: (x - point) . normal < 0.
struct HalfSpace {
  Vec3d point{0.0}, normal{0.0, 0.0, 1.0};
};

// A closed triangle mesh from a file (OBJ, PLY or STL); x_world = scale * x_file + translate.
struct MeshShape {
  std::filesystem::path file;
  double scale = 1.0;
  Vec3d translate{0.0};
};

struct Shape;

struct Union {
  std::vector<Shape> parts;
};

// The first part less all the others.
struct Difference {
  std::vector<Shape> parts;
};

struct Shape {
  std::variant<Box, Sphere, HalfSpace, MeshShape, Union, Difference> kind;
};

inline constexpr double kForever = std::numeric_limits<double>::infinity();

// Liquid that is put into the domain at time `from` (seconds), where no solid is.
struct LiquidBody {
  Shape shape;
  Vec3d velocity{0.0};  // m/s
  double from = 0.0;
};

// A static solid that exists for from <= t < until (seconds).
struct Solid {
  std::string name;
  Shape shape;
  double from = 0.0, until = kForever;
  bool visible = true;
  Vec3d color{0.5, 0.5, 0.5};  // linear RGB, how it is drawn where visible
};

struct Options {
  Vec3d size{1.0};      // of the domain, metres; its six faces are walls
  int resolution = 64;  // cells along the longest side
  Vec3d gravity{0.0, 0.0, -9.81};
  double density = 1000.0;   // kg/m3
  double viscosity = 0.001;  // Pa s
  double cfl = 3.0;          // a substep moves nothing further than this many cells
  double frameRate = 24.0;   // frames a second
  std::vector<LiquidBody> liquid;
  std::vector<Solid> solids;

  double voxelSize() const { return std::max({size.x(), size.y(), size.z()}) / resolution; }
};

}  // namespace fluidtex::sim
