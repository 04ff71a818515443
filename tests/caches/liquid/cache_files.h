// Caches of flows in closed form, in each way that programs write them: OpenVDB, and all else byte by byte.
#pragma once

#include "caches/liquid/cached_flow.h"
#include "caches/liquid/survey.h"
#include "caches/options.h"
#include "tests/caches/formats/written_bytes.h"
#include "tests/caches/liquid/flows.h"
#include "tests/caches/liquid/geometry_bytes.h"

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

namespace fluidtex::caches {

enum class Way {
  staggered,         // level set and vectors at faces
  collocated,        // level set and vectors at the voxels' centres, in 16 bits
  threeGrids,        // level set, vel.x vel.y vel.z
  fog,               // density and vectors
  turned,            // level set and vectors on a lattice that is turned, in decimetres
  yUpMillimeters,    // level set and vectors of a Y-up program
  ply,               // mesh with vx vy vz
  plyYUp,            // the same, Y up and in millimetres
  plyAndGrids,       // mesh, and vectors at faces in files beside it
  mantaflowMesh,     // Blender: mesh, vectors at faces of a turned and scaled domain
  mantaflowAligned,  // Blender: the same of one that is neither
  mantaflowGrids,    // Blender, resumable, no mesh: distances in voxels
  flipFluids,        // mesh, velocities in the simulation's unit, blur
  vtk,               // particles with velocities
};
inline constexpr Way kWays[] = {Way::staggered,
                                Way::collocated,
                                Way::threeGrids,
                                Way::fog,
                                Way::turned,
                                Way::yUpMillimeters,
                                Way::ply,
                                Way::plyYUp,
                                Way::plyAndGrids,
                                Way::mantaflowMesh,
                                Way::mantaflowAligned,
                                Way::mantaflowGrids,
                                Way::flipFluids,
                                Way::vtk};
std::string nameOf(Way way);

struct CacheFiles {
  Options options;  // path, names and placement
  // How far the surface that is read may be from the ball's, cells. Triangles of grids lie a little inside.
  double accuracy = 0.07;
};

// Frames 1 to `frames`, 1 / frameRate apart from time 0 on, of a ball in a flow, as if seen in the world
// (metres, Z up). h: side of the cells. velocityScale: what velocities are written with.
struct Clip {
  Flow flow;
  Ball ball;
  int frames = 3;
  double frameRate = 24.0;
  double h = 1.0 / 32.0;
  double velocityScale = 1.0;

  Ball at(int frame) const { return {flow.moved(ball.center, time(frame)), ball.radius}; }
  double time(int frame) const { return (frame - 1) / frameRate; }
};
CacheFiles writeCache(Way way, const Clip& clip, const std::filesystem::path& folder);

void writeBytes(const std::filesystem::path& file, const std::string& bytes);

inline Cache cacheOf(const Options& options, const Clip& clip) {
  return {options, recognize(options), clip.h, clip.frameRate};
}

inline std::vector<sim::Frame> framesOf(const Options& options, const Clip& clip) {
  CachedFlow flow(cacheOf(options, clip));
  std::vector<sim::Frame> frames;
  for (int n = 0; n < clip.frames; ++n) frames.push_back(flow.next());
  return frames;
}

}  // namespace fluidtex::caches
