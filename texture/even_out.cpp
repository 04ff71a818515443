// Repulsion after Turk, "Generating textures on arbitrary surfaces using reaction-diffusion" (1991), between
// mesh neighbours instead of all points near by, with the mesh kept Delaunay as in Persson, Strang, "A simple
// mesh generator in MATLAB" (2004).
#include "texture/adjust.h"
#include "texture/mend.h"
#include "texture/relax.h"
#include "texture/remesh.h"
#include "texture/repulsion.h"

#include <algorithm>

namespace fluidtex::texture {
namespace {

constexpr std::uint32_t kNone = EditableMesh::kNone;

// Points at random: all of them have to move. The number is put right while they do.
void spreadOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options, float edge) {
  constexpr int kAtOnce = 3;        // sweeps between two numberings
  constexpr float kPatch = 40.0f;   // its side in edges: what is worked on fits into the nearer cache
  constexpr float kShift = 0.382f;  // of the side, from round to round: what lay between patches comes inside
  constexpr double kSlack = 0.005;
  // A fourth sweep for each three is evenOut's own, for what is then still out of balance.
  const int rounds = std::max(1, options.sweeps / (kAtOnce + 1));
  const float side = kPatch * edge;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<std::uint32_t> changed =
        adjustNumber(mesh, phi, {edge, options.points, kSlack, options.settled});
    if (!changed.empty()) flipToDelaunay(mesh, &changed);
    relax(mesh, phi, patchesOf(mesh, side, Vec3f(kShift * side * float(round))), edge, kAtOnce);
  }
  flipToDelaunay(mesh);
}

}  // namespace

void evenOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options) {
  // In sweeps' pushes, mean edge lengths: a vertex at rest wakes above kWake, and moves until it is below
  // kSleep. The gap between them is what keeps a liquid at rest from shimmering.
  constexpr float kWake = 0.02f, kSleep = 0.005f;
  constexpr int kMostSweeps = 104, kCounted = 20;
  constexpr double kSlack = 0.015;
  const float edge = options.spacing * kEdgePerSpacing;
  const std::size_t inOrder = mesh.vertexCount();
  if (!options.settled) spreadOut(mesh, phi, options, edge);
  Repulsion repulsion(mesh, phi, edge);
  repulsion.awake.assign(mesh.vertexCount(), options.settled ? 0 : 1);
  std::vector<std::uint32_t> active, changed, next;
  std::vector<int> listed;  // the last sweep for which a vertex was listed
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    changed.clear();
    // The number is put right while much moves; later only what is out of all proportion changes: each of the
    // two might undo the other for ever.
    const bool everywhere = (options.settled && sweep < 4) || active.empty();
    if (everywhere || sweep % 5 == 0) {
      const double slack = options.settled && sweep <= kCounted ? kSlack : 1.0;
      changed = adjustNumber(mesh, phi, {edge, options.points, slack, options.settled},
                             everywhere ? nullptr : &active);
      repulsion.awake.resize(mesh.vertexCount(), 1);
      for (std::uint32_t v : changed) repulsion.awake[v] = 1;
      if (!changed.empty()) flipToDelaunay(mesh, &changed);
    }
    if (sweep == 0) {
      active.clear();
      for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
        if (mesh.outgoing[v] != kNone) active.push_back(v);
      }
    } else {
      // Only what has moved, and its neighbours, can be out of balance now.
      listed.resize(mesh.vertexCount(), -1);
      next.clear();
      const auto list = [&](std::uint32_t v) {
        if (listed[v] == sweep) return;
        listed[v] = sweep;
        next.push_back(v);
      };
      for (const std::vector<std::uint32_t>* source : {&active, &changed}) {
        for (std::uint32_t v : *source) {
          if (mesh.outgoing[v] == kNone) continue;
          list(v);
          mesh.around(v, [&](std::uint32_t h) { list(mesh.target(h)); });
        }
      }
      active.swap(next);
    }
    repulsion.sweep(active, kWake, kSleep);
    if (active.empty() && changed.empty() && everywhere) break;
    flipToDelaunay(mesh, &active);
  }
  mend(mesh, phi, options.spacing);
  mesh.compact(inOrder);
}

}  // namespace fluidtex::texture
