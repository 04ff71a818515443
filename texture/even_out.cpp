// Repulsion after Turk, "Generating textures on arbitrary surfaces using reaction-diffusion" (1991), between
// mesh neighbours instead of all points near by, with the mesh kept Delaunay as in Persson, Strang, "A simple
// mesh generator in MATLAB" (2004).
#include "texture/remesh.h"

#include "texture/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace fluidtex::texture {
namespace {

constexpr std::uint32_t kNone = EditableMesh::kNone;

struct Spreader {
  EditableMesh& mesh;
  const LevelSet& phi;
  const EvenOptions& options;
  const float edge = options.spacing * kEdgePerSpacing;  // mean length of an even mesh's edges
  std::vector<std::uint8_t> awake{};                     // #V: out of balance, moving
  std::vector<Vec3f> oldPosition{}, oldNormal{};         // #movers

  float length(std::uint32_t h) const {
    return (mesh.position[mesh.origin[h]] - mesh.position[mesh.target(h)]).length();
  }

  // Where repulsion drives a vertex in one sweep, tangent to the surface.
  Vec3f push(std::uint32_t v) const {
    // Neighbours repel up to 1.25 mean edge lengths: beyond it a Delaunay flip turns edges, and no force may
    // jump there.
    constexpr float kRange = 1.25f;
    constexpr float kStep = 0.2f;  // of the distance that would undo the overlap: stable for six neighbours
    constexpr float kLongest = 0.25f;  // mean edge lengths in one sweep
    const Vec3f at = mesh.position[v];
    Vec3f sum(0.0f);
    mesh.around(v, [&](std::uint32_t h) {
      const Vec3f away = at - mesh.position[mesh.target(h)];
      const float distance = away.length();
      if (distance > 0.0f && distance < kRange * edge) sum += away * ((kRange * edge - distance) / distance);
    });
    sum *= kStep;
    sum -= mesh.normal[v] * mesh.normal[v].dot(sum);
    const float size = sum.length();
    if (size > kLongest * edge) sum *= kLongest * edge / size;
    return sum;
  }

  // One sweep over the vertices in `active`: all that are awake move at once. Returns those that moved.
  std::vector<std::uint32_t> sweep(const std::vector<std::uint32_t>& active, float wake, float sleep) {
    std::vector<Vec3f> moves(active.size());
    forEachIndex(active.size(), [&](std::uint32_t i) {
      const std::uint32_t v = active[i];
      moves[i] = push(v);
      const float limit = (awake[v] ? sleep : wake) * edge;
      awake[v] = moves[i].lengthSqr() > limit * limit;
    });
    std::vector<std::uint32_t> movers;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (!awake[active[i]]) continue;
      movers.push_back(active[i]);
      moves[kept++] = moves[i];
    }
    oldPosition.resize(movers.size());
    oldNormal.resize(movers.size());
    forEachIndex(movers.size(), [&](std::uint32_t i) {
      const std::uint32_t v = movers[i];
      oldPosition[i] = mesh.position[v];
      oldNormal[i] = mesh.normal[v];
      const LevelSet::Projection p = phi.project(oldPosition[i] + moves[i], edge);
      if (!p.known) return;
      mesh.position[v] = p.position;
      mesh.normal[v] = p.normal;
    });
    revertFolds(movers);
    // At a crease, or where a move was taken back, a push moves nothing: such vertices are at rest as well.
    kept = 0;
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const std::uint32_t v = movers[i];
      const float moved = (mesh.position[v] - oldPosition[i]).length();
      if (moved > sleep * edge) {
        movers[kept++] = v;
        continue;
      }
      awake[v] = 0;
      mesh.position[v] = oldPosition[i];
      mesh.normal[v] = oldNormal[i];
    }
    movers.resize(kept);
    return movers;
  }

  // Takes back moves until no triangle is folded that was not before. Ends: at worst all moves are taken
  // back.
  void revertFolds(const std::vector<std::uint32_t>& movers) {
    std::vector<std::uint8_t> undo(movers.size());
    std::vector<std::uint32_t> suspects(movers.size());
    for (std::uint32_t i = 0; i < movers.size(); ++i) suspects[i] = i;
    std::vector<std::uint8_t> reverted(movers.size(), 0);
    while (true) {
      forEachIndex(suspects.size(), [&](std::uint32_t k) {
        const std::uint32_t i = suspects[k];
        undo[i] = !reverted[i] && worstFacing(mesh, movers[i]) < kFacing;
      });
      std::vector<std::uint32_t> left;
      bool any = false;
      for (std::uint32_t i : suspects) {
        if (reverted[i]) continue;
        if (!undo[i]) {
          left.push_back(i);
          continue;
        }
        any = true;
        reverted[i] = 1;
        mesh.position[movers[i]] = oldPosition[i];
        mesh.normal[movers[i]] = oldNormal[i];
      }
      if (!any) return;
      suspects.swap(left);
    }
  }

  // How large a gap an edge crosses: its own length, or the wider of the circles around its triangles. For
  // the four corners of a rectangle it does not matter which diagonal the mesh has. Mean edge lengths.
  float gap(std::uint32_t h, float ownLength) const {
    float widest = ownLength;
    for (std::uint32_t side : {h, mesh.twin[h]}) {
      const Vec3f c = mesh.position[mesh.opposite(side)];
      const Vec3f u = mesh.position[mesh.origin[side]] - c, v = mesh.position[mesh.target(side)] - c;
      const float area2 = u.cross(v).length();
      if (area2 > 0.0f) widest = std::max(widest, ownLength * u.length() * v.length() / area2);
    }
    return widest;
  }

  // Splits what is far too long, collapses what is far too short, and then the worst edges until the number
  // of points is within `slack` of what it should be. Lists all vertices whose surroundings changed.
  void adjust(double slack, std::vector<std::uint32_t>& dirty) {
    // Mean edge lengths. Points that were even in the last frame get some margin, so that nothing flickers at
    // the limits.
    const float tooShort = options.settled ? 0.6f : 0.63f, tooLong = options.settled ? 1.8f : 1.7f;
    constexpr float kShort = 0.95f, kLong = 1.1f;  // only these are touched for the sake of the number
    constexpr float kMaybeLong = 1.4f;             // shorter edges cross no gap
    struct Candidate {
      float length;
      std::uint32_t halfEdge;
      std::uint32_t a, b;
      bool operator<(const Candidate& o) const {
        return length != o.length ? length < o.length : halfEdge < o.halfEdge;
      }
    };
    std::vector<Candidate> shortest, longest;
    std::size_t alive = 0;
    for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) alive += mesh.outgoing[v] != kNone;
    const double excess = double(alive) - options.points;
    const bool many = excess > slack * options.points, few = -excess > slack * options.points;
    for (std::uint32_t h = 0; h < mesh.halfEdgeCount(); ++h) {
      if (!mesh.alive(h) || h > mesh.twin[h]) continue;
      const float l = length(h) / edge;
      const Candidate c{l, h, mesh.origin[h], mesh.target(h)};
      if (l < (many ? kShort : tooShort)) shortest.push_back(c);
      const float across = l > kMaybeLong ? gap(h, l) : l;
      if (across > (few ? kLong : tooLong)) longest.push_back({across, h, c.a, c.b});
    }
    std::sort(shortest.begin(), shortest.end());
    std::sort(longest.begin(), longest.end());
    std::reverse(longest.begin(), longest.end());

    std::vector<std::uint8_t> touched(mesh.vertexCount(), 0);
    const auto same = [&](const Candidate& c) {  // the candidate's half-edge is still the edge it was
      return mesh.alive(c.halfEdge) && mesh.origin[c.halfEdge] == c.a && mesh.target(c.halfEdge) == c.b &&
             !touched[c.a] && !touched[c.b];
    };
    const auto touch = [&](std::uint32_t v) {
      mesh.around(v, [&](std::uint32_t h) {
        touched[mesh.target(h)] = 1;
        dirty.push_back(mesh.target(h));
      });
      touched[v] = 1;
      dirty.push_back(v);
    };
    double toRemove = many ? excess : 0.0, toAdd = few ? -excess : 0.0;
    for (const Candidate& c : shortest) {
      if (c.length >= tooShort && toRemove < 1.0) break;
      if (!same(c)) continue;
      const std::uint32_t h = c.halfEdge, t = mesh.twin[h];
      if (tryCollapse(mesh, h)) {
        touch(c.b);
      } else if (tryCollapse(mesh, t)) {
        touch(c.a);
      } else {
        continue;
      }
      toRemove -= 1.0;
    }
    for (const Candidate& c : longest) {
      if (c.length <= tooLong && toAdd < 1.0) break;
      if (!same(c)) continue;
      const std::uint32_t m = splitOnSurface(mesh, c.halfEdge, phi);
      touched.push_back(1);
      awake.push_back(1);
      touch(m);
      toAdd -= 1.0;
    }
    for (std::uint32_t v : dirty) awake[v] = 1;
    flipToDelaunay(mesh, &dirty);
  }
};

}  // namespace

void evenOut(EditableMesh& mesh, const LevelSet& phi, const EvenOptions& options) {
  // In sweeps' pushes, mean edge lengths: a vertex at rest wakes above kWake, and moves until it is below
  // kSleep. The gap between them is what keeps a liquid at rest from shimmering.
  constexpr float kWake = 0.02f, kSleep = 0.005f;
  constexpr int kMostSweeps = 120, kSettledCounted = 20;
  constexpr int kReorder = 4;  // most fresh vertices have been made by then
  constexpr double kSlack = 0.005, kSettledSlack = 0.015;
  Spreader spreader{mesh, phi, options};
  spreader.awake.assign(mesh.vertexCount(), options.settled ? 0 : 1);
  const int counted = options.settled ? kSettledCounted : options.sweeps - 1;
  std::vector<std::uint32_t> active, changed, next;
  std::vector<int> listed;                 // the last sweep for which a vertex was listed
  std::size_t fresh = mesh.vertexCount();  // later vertices are not in order yet
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    if (sweep == kReorder && !options.settled) {
      mesh.compact(fresh);
      fresh = mesh.vertexCount();
      spreader.awake.assign(fresh, 1);
      listed.assign(fresh, -1);
      active.resize(fresh);
      std::iota(active.begin(), active.end(), 0u);
    }
    changed.clear();
    // The number is put right while much moves; later only what is out of all proportion changes: each of the
    // two might undo the other for ever.
    const bool adjusting = sweep < 4 || sweep % 5 == 0 || active.empty();
    const double slack = sweep > counted ? 1.0 : options.settled ? kSettledSlack : kSlack;
    if (adjusting) spreader.adjust(slack, changed);
    const bool everything = !options.settled && sweep < options.sweeps;
    if (sweep == 0) {
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
    active = spreader.sweep(active, kWake, everything ? 0.0f : kSleep);
    if (active.empty() && changed.empty() && adjusting) break;
    flipToDelaunay(mesh, &active);
  }
  mesh.compact(fresh);
}

}  // namespace fluidtex::texture
