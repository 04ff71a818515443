// What lies where in a cache: which files and grids hold the surface and the velocity of a liquid.
#pragma once

#include "caches/layouts/numbered_files.h"
#include "caches/options.h"

#include <string>
#include <vector>

namespace fluidtex::caches {

enum class Program { mantaflow, flipFluids, unknown };

// mantaflow: distances in voxels, which include solids (phi and phi_obstacle).
enum class SurfaceKind { mesh, levelSet, fog, mantaflow, particles };

// attribute: values at the points of the surface's own files. flipFluids: the points of velocity######.bobj.
enum class VelocityKind { none, grids, attribute, flipFluids };

// A further grid, or attribute at points: temperature, age, colour.
struct Field {
  std::string name;           // as in the file
  bool vectors = false;       // three numbers, else one
  bool withVelocity = false;  // a grid of the files that hold the velocity, else one of the surface's files
  friend bool operator==(const Field&, const Field&) = default;
};

// What a field's numbers are called from here on: its name in letters, digits and _; of vectors each with _x,
// _y and _z ("Cd_x").
std::vector<std::string> scalarNames(const Field& field);

struct Layout {
  Program program = Program::unknown;
  SurfaceKind surfaceKind = SurfaceKind::mesh;
  VelocityKind velocityKind = VelocityKind::none;
  NumberedFiles surface, velocity;  // empty where the kind has none of its own
  NumberedFiles config;             // of mantaflow: place, size and clock of each frame
  NumberedFiles blur;               // of FLIP Fluids: displacements of a frame
  std::string surfaceName;          // of the grid
  // Of the attribute; of one grid of vectors, or of three grids.
  std::vector<std::string> velocityNames;
  bool onFaces = false;  // a grid of vectors holds the components at the voxels' lower faces
  std::vector<Field> fields;
  int first = 1, last = 0;  // numbers of the frames that can be textured

  int frames() const { return last - first + 1; }
};

// Finds out what options.path holds: Blender's (mantaflow) or FLIP Fluids' cache folder, a folder with
// sequences of OpenVDB, mesh or particle files, one of these files, or a pattern. A file of a known cache
// stands for the cache, unless velocities are named. Names that the options give are taken as they are. Reads
// what files say of themselves, and the first one of geometry that holds points. Throws
// LayoutError: nothing that can be read, a surface or its files missing, or several that it could be.
Layout recognize(const Options& options);

// What was taken for what, a line each, for people.
std::vector<std::string> describe(const Layout& layout);

}  // namespace fluidtex::caches
