// Repulsion after Turk, "Generating textures on arbitrary surfaces using reaction-diffusion" (1991), between
// mesh neighbours instead of all points near by, with the mesh kept Delaunay as in Persson, Strang, "A simple
// mesh generator in MATLAB" (2004).
#include "texture/adjust.h"
#include "texture/mend.h"
#include "texture/remesh.h"
#include "texture/repulsion.h"

#include <numeric>

namespace fluidtex::texture {
namespace {

constexpr std::uint32_t kNone = EditableMesh::kNone;

}  // namespace

void evenOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options) {
  // In sweeps' pushes, mean edge lengths: a vertex at rest wakes above kWake, and moves until it is below
  // kSleep. The gap between them is what keeps a liquid at rest from shimmering.
  constexpr float kWake = 0.02f, kSleep = 0.005f;
  constexpr int kMostSweeps = 120, kSettledCounted = 20;
  constexpr int kReorder = 4;  // most fresh vertices have been made by then
  constexpr double kSlack = 0.005, kSettledSlack = 0.015;
  const float edge = options.spacing * kEdgePerSpacing;
  Repulsion repulsion(mesh, phi, edge);
  repulsion.awake.assign(mesh.vertexCount(), options.settled ? 0 : 1);
  const int counted = options.settled ? kSettledCounted : options.sweeps - 1;
  std::vector<std::uint32_t> active, changed, next;
  std::vector<int> listed;                 // the last sweep for which a vertex was listed
  std::size_t fresh = mesh.vertexCount();  // later vertices are not in order yet
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    if (sweep == kReorder && !options.settled) {
      mesh.compact(fresh);
      repulsion.forget();
      fresh = mesh.vertexCount();
      repulsion.awake.assign(fresh, 1);
      listed.assign(fresh, -1);
      active.resize(fresh);
      std::iota(active.begin(), active.end(), 0u);
    }
    changed.clear();
    // The number is put right while much moves; later only what is out of all proportion changes: each of the
    // two might undo the other for ever.
    const bool adjusting = sweep < 4 || sweep % 5 == 0 || active.empty();
    if (adjusting) {
      const double slack = sweep > counted ? 1.0 : options.settled ? kSettledSlack : kSlack;
      changed = adjustNumber(mesh, phi, {edge, options.points, slack, options.settled},
                             sweep < 4 || active.empty() ? nullptr : &active);
      repulsion.awake.resize(mesh.vertexCount(), 1);
      for (std::uint32_t v : changed) repulsion.awake[v] = 1;
      if (!changed.empty()) flipToDelaunay(mesh, &changed);
    }
    const bool everything = !options.settled && sweep < options.sweeps;
    if (sweep == 0 || everything) {
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
    repulsion.sweep(active, kWake, everything ? 0.0f : kSleep);
    if (active.empty() && changed.empty() && adjusting) break;
    flipToDelaunay(mesh, &active);
  }
  mend(mesh, phi, options.spacing);
  mesh.compact(fresh);
}

}  // namespace fluidtex::texture
