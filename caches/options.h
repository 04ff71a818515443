// Settings of a liquid that another program has simulated: [files] of a scene.
#pragma once

#include "sim/mesh_place.h"
#include "sim/vec3.h"

#include <filesystem>
#include <string>

namespace fluidtex::caches {

using sim::UpAxis;
using sim::Vec3d;

// In a folder of the program's own frames: what they are of (caches/recorded/recording.h).
inline constexpr const char* kRecordingFile = "cache.json";

// Where the files are, what is taken of them, and where it is placed. Whatever is empty or 0 here is found
// out from the files (caches/layouts/layout.h).
struct Options {
  // A program's cache folder, one file of a sequence, or a pattern: #### or %04d stands for the number.
  std::filesystem::path path;
  std::filesystem::path velocity;  // the same for files of velocity that are not those of the surface
  std::string surfaceName;         // of the grid that holds the surface
  std::string velocityName;        // of the grid or attribute of velocity; three grids: "u,v,w"
  int first = -1;                  // number of the file that is the first frame; negative: the lowest
  double unit = 1.0;               // metres a unit of length of the files
  UpAxis up = UpAxis::z;
  // Then, in this order: turned about x, y and z (degrees), enlarged, moved (metres).
  Vec3d turn{0.0};
  double scale = 1.0;
  Vec3d move{0.0};
  double iso = 0.0;            // value of densities at the surface; 0: half of the largest of each frame
  double velocityScale = 1.0;  // factor on the velocities of the files
  double radius = 0.0;         // of particles, in the files' unit
  double voxel = 0.0;          // side of the level set's cells, metres
  double leastPiece = 0.0;     // m3: pieces of less volume are left out
  // Below this share of the surface's motion that its velocity explains, a run ends.
  double leastExplained = 0.3;
  // Where the files have no velocities: motion across the surface alone, see fittedVelocity().
  bool fit = false;
  // Whether files that are not there yet are waited for, as the other program still runs.
  bool follow = false;
};

}  // namespace fluidtex::caches
