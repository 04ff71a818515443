// Repulsion after Turk, "Generating textures on arbitrary surfaces using reaction-diffusion" (1991), between
// mesh neighbours instead of all points near by, with the mesh kept Delaunay as in Persson, Strang, "A simple
// mesh generator in MATLAB" (2004).
#include "texture/loops/parallel.h"
#include "texture/mesh/adjust.h"
#include "texture/mesh/fair.h"
#include "texture/mesh/mend.h"
#include "texture/mesh/relax.h"
#include "texture/mesh/remesh.h"
#include "texture/mesh/repulsion.h"

#include <algorithm>
#include <atomic>
#include <initializer_list>

namespace fluidtex::texture {
namespace {

// Relative error of the number of points that is tolerated if they were even in the last frame.
constexpr double kSettledSlack = 0.015;

// Relaxes newly connected points: all of them if random, else new ones and their surroundings. awake: as for
// relax().
void spreadOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options, float edge,
               std::vector<std::uint8_t>& awake) {
  constexpr int kAtOnce = 3;        // sweeps in the same patches
  constexpr int kNumbered = 3;      // rounds that start by adjusting the number of points
  constexpr float kPatch = 40.0f;   // its side in edges: what is worked on fits into the nearer cache
  constexpr float kShift = 0.382f;  // of the side, from round to round: what lay between patches comes inside
  const double slack = options.settled ? kSettledSlack : 0.001;
  // Above kWake of evenOut(), whose steps are shorter.
  const float wake = options.settled ? 0.06f : 0.0f;
  // evenOut() adds a fourth sweep to each three, for what is still out of balance then.
  const int rounds = std::max(1, options.sweeps / (kAtOnce + 1));
  const float side = kPatch * edge;
  for (int round = 0; round < rounds; ++round) {
    if (round < kNumbered) {
      const std::vector<std::uint32_t> changed =
          adjustNumber(mesh, phi, {edge, options.points, slack, options.settled});
      awake.resize(mesh.vertexCount(), 1);
      for (std::uint32_t v : changed) awake[v] = 1;
      if (!changed.empty()) flipToDelaunay(mesh, &changed);
    }
    relax(mesh, phi, patchesOf(mesh, side, Vec3f(kShift * side * float(round))), edge, kAtOnce, wake, awake);
  }
  flipToDelaunay(mesh);
}

// The listed vertices and their neighbours: only these can be out of balance.
std::vector<std::uint32_t> withNeighbors(const EditableMesh& mesh,
                                         std::initializer_list<const std::vector<std::uint32_t>*> lists) {
  std::vector<std::uint8_t> listed(mesh.vertexCount(), 0);
  const auto list = [&](std::uint32_t v) {
    std::atomic_ref<std::uint8_t>(listed[v]).store(1, std::memory_order_relaxed);
  };
  for (const std::vector<std::uint32_t>* vertices : lists)
    forEachIndex(vertices->size(), [&](std::uint32_t i) {
      const std::uint32_t v = (*vertices)[i];
      if (mesh.outgoing[v] == kNone) return;
      list(v);
      mesh.around(v, [&](std::uint32_t h) { list(mesh.target(h)); });
    });
  using Vertices = std::vector<std::uint32_t>;
  return gathered<std::uint32_t>(
      listed.size(),
      [&](std::uint32_t v, Vertices& found) {
        if (listed[v]) found.push_back(v);
      },
      1 << 14);
}

}  // namespace

void evenOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options) {
  // Thresholds on a sweep's displacement, mean edge lengths: a vertex at rest wakes above kWake, and moves
  // until it is below kSleep. This hysteresis keeps a liquid at rest from shimmering.
  constexpr float kWake = 0.02f, kSleep = 0.005f;
  constexpr int kMostSweeps = 52, kCounted = 20;
  const float edge = options.spacing * kEdgePerSpacing;
  const std::size_t inOrder = mesh.vertexCount();
  Repulsion repulsion(mesh, phi, edge);
  repulsion.awake.assign(inOrder, options.settled ? 0 : 1);
  if (!options.kept) {
    spreadOut(mesh, phi, options, edge, repulsion.awake);
    repulsion.awake.assign(mesh.vertexCount(), options.settled ? 0 : 1);
  }
  std::vector<std::uint32_t> active, changed;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    changed.clear();
    // The number is adjusted while many vertices move; later only extreme edges change, since adjustment and
    // repulsion might undo each other forever.
    const bool everywhere = (options.settled && sweep < 4) || active.empty();
    if (everywhere || sweep % 5 == 0) {
      const double slack = options.settled && sweep <= kCounted ? kSettledSlack : 1.0;
      changed = adjustNumber(mesh, phi, {edge, options.points, slack, options.settled},
                             everywhere ? nullptr : &active);
      repulsion.awake.resize(mesh.vertexCount(), 1);
      for (std::uint32_t v : changed) repulsion.awake[v] = 1;
      if (!changed.empty()) flipToDelaunay(mesh, &changed);
    }
    if (sweep == 0) {
      active.clear();
      for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v)
        if (mesh.outgoing[v] != kNone) active.push_back(v);
    } else {
      active = withNeighbors(mesh, {&active, &changed});
    }
    repulsion.sweep(active, kWake, kSleep);
    if (active.empty() && changed.empty() && everywhere) break;
    flipToDelaunay(mesh, &active);
  }
  mend(mesh, phi, options.spacing);
  fair(mesh, phi);
  mesh.compact(inOrder);
}

}  // namespace fluidtex::texture
