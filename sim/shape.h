// Shapes of liquid, solids, sources and drains, as a scene gives them. Metres, world space.
#pragma once

#include "sim/mesh_place.h"
#include "sim/vec3.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace fluidtex::sim {

struct Box {
  Vec3d min{0.0}, max{1.0};
};

struct Sphere {
  Vec3d center{0.0};
  double radius = 1.0;
};

// Round, with flat ends at `from` and `to`.
struct Cylinder {
  Vec3d from{0.0}, to{0.0, 0.0, 1.0};
  double radius = 0.5;
};

// Everything behind the plane: (x - point) . normal < 0.
struct HalfSpace {
  Vec3d point{0.0}, normal{0.0, 0.0, 1.0};
};

// A closed triangle mesh from a file (OBJ, PLY or STL).
struct MeshShape {
  std::filesystem::path file;
  MeshPlace place{};
};

// A surface that changes its shape: closed meshes in numbered files of the same formats. The file with number
// `first` shows it at time `start` (seconds), each next one 1/frameRate later. All have the same vertices and
// faces in the same order; each vertex moves in straight lines from file to file. Before the first and after
// the last the surface is at rest. Only solids change their shape; liquid, sources and drains stay as in the
// first file.
struct MeshSequence {
  std::filesystem::path files;  // with a place for the number in its last part: %d, or %04d for four digits
  int first = 1, last = 1;
  double frameRate = 24.0, start = 0.0;
  MeshPlace place{};

  // The time of the n-th file, counted from 0, s.
  double timeOf(int n) const { return start + n / frameRate; }
  std::filesystem::path fileOf(int n) const {
    std::string name = files.filename().string(), number = std::to_string(first + n);
    const std::size_t at = name.find('%'), letter = name.find('d', at);
    if (at == std::string::npos || letter == std::string::npos) return files;
    const std::size_t digits = letter == at + 3 ? std::size_t(name[at + 2] - '0') : 0;
    if (number.size() < digits) number.insert(0, digits - number.size(), '0');
    return files.parent_path() / name.replace(at, letter + 1 - at, number);
  }
  int count() const { return last - first + 1; }
};

// Ground from a grey image of 8 or 16 bits: black lies at height `low`, white at `high`; one pixel is `pixel`
// metres wide, the picture's top is at high y. translate: of its lower left corner, and of all heights.
// Between pixel centres the heights are bicubic. Everything below is inside. Where the picture ends at a side
// of [0, size] or beyond, its rim extends outward without end; on unbounded sides it does so wherever it
// ends.
struct HeightField {
  std::filesystem::path file;
  double pixel = 1.0;
  double low = 0.0, high = 1.0;
  Vec3d translate{0.0};
};

struct Shape;

struct Union {
  std::vector<Shape> parts;
};

// The first part minus all the others.
struct Difference {
  std::vector<Shape> parts;
};

// A further kind needs: its struct and its place in this list, its distance (sim/shapes/shape_distance.cpp),
// its triangles (sim/shapes/shape_triangles.cpp), and its keys in scene files, in the same order
// (scenes/schema.h, scenes/schema_shapes.cpp, scenes/check_shapes.cpp).
struct Shape {
  std::variant<Box, Sphere, Cylinder, HalfSpace, MeshShape, MeshSequence, HeightField, Union, Difference>
      kind;
};

}  // namespace fluidtex::sim
