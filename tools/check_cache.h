// fluidtex check of another program's cache: what is in it, and whether surface and velocity fit together.
#pragma once

#include "scenes/scene.h"
#include "tools/commands.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <vector>

namespace fluidtex::tools {

struct CheckCacheWishes {
  int pairs = 5;               // of frames that are compared, at most
  std::filesystem::path json;  // for what they say of each other; empty: none
};

// What the frames of these two numbers say of each other.
struct ComparedFrames {
  int from = 0, to = 0;
  double fastest = 0.0;  // m/s, at `from`
  double speed = 0.0;    // mean on the surface there, m/s
  // Of the surface at `from`:
  double area = 0.0;                   // m2
  std::optional<double> offset;        // mean distance of a mesh from the level set that is made of it, cells
  openvdb::Vec3d low{0.0}, high{0.0};  // its bounds, m
  std::vector<openvdb::Vec3f> first;   // its first vertices, three at most
  // Nothing where the surface moves too little to tell.
  std::optional<double> moved;      // mean distance of its points that moved, cells
  std::optional<double> left;       // the same after they went with the velocities
  std::optional<double> explained;  // share of the motion that the velocities explain
  std::optional<double> bulk;       // the same of the bulk alone, away from what is thin
  // Displacement over velocity: the factor on the velocities with which least is left. Nothing where no
  // factor leaves less than nine tenths.
  std::optional<double> ratio;
};

// Prints what the cache was taken for, where it lies, compareFrames() of all of its frames, and how many
// points the texture would have. Throws as loadScene().
void checkCache(const CommonOptions& options, const CheckCacheWishes& wishes);

// Prints how far the surface moves in pairs of the frames `first` to `last`, evenly taken, and how much of it
// the velocities explain; warns where another factor on them would do better. None of the program's own
// recordings.
std::vector<ComparedFrames> compareFrames(const scenes::Scene& scene, int first, int last,
                                          const CheckCacheWishes& wishes);

// Prints the number and distance of points on the surfaces that were compared. Returns the most; 0 where
// there are none.
double printPoints(const scenes::Scene& scene, const std::vector<ComparedFrames>& compared);

}  // namespace fluidtex::tools
