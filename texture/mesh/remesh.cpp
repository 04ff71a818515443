// Flips, splits and collapses after Botsch, Kobbelt, "A remeshing approach to multiresolution modeling"
// (2004).
#include "texture/mesh/remesh.h"

#include "texture/loops/parallel.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Whether the angles opposite to an edge sum to more than pi, with a tolerance for rounding.
bool violatesDelaunay(const EditableMesh& mesh, std::uint32_t h) {
  constexpr float kSlack = 1e-4f;
  const std::uint32_t t = mesh.twin[h];
  const Vec3f &a = mesh.position[mesh.origin[h]], &b = mesh.position[mesh.origin[t]];
  const Vec3f &c = mesh.position[mesh.opposite(h)], &d = mesh.position[mesh.opposite(t)];
  const Vec3f ca = a - c, cb = b - c, da = a - d, db = b - d;
  const float cosC = ca.dot(cb), cosD = da.dot(db);
  if (cosC >= 0.0f && cosD >= 0.0f) return false;
  const float sinC = ca.cross(cb).length(), sinD = da.cross(db).length();
  const float excess = cosC * sinD + cosD * sinC;
  return excess < 0.0f &&
         excess * excess > kSlack * kSlack * (cosC * cosC + sinC * sinC) * (cosD * cosD + sinD * sinD);
}

float facingOf(const EditableMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec3f p[3] = {mesh.position[a], mesh.position[b], mesh.position[c]};
  const Vec3f n[3] = {mesh.normal[a], mesh.normal[b], mesh.normal[c]};
  return facing(p, n);
}

bool flipFolds(const EditableMesh& mesh, std::uint32_t h) {
  const std::uint32_t t = mesh.twin[h];
  const std::uint32_t a = mesh.origin[h], b = mesh.origin[t], c = mesh.opposite(h), d = mesh.opposite(t);
  const float now = std::min(facingOf(mesh, a, d, c), facingOf(mesh, d, b, c));
  return now < kFacing && !mayFace(now, std::min(facingOf(mesh, a, b, c), facingOf(mesh, b, a, d)));
}

// Flipping terminates on a plane; on a coarsely sampled surface it might cycle.
std::size_t flipBudget(std::size_t halfEdges) {
  return 10 * halfEdges;
}

// Flips edges on the stack that violate Delaunay, and those that this affects, among the `allowed` ones.
template <typename Allowed>
void settle(EditableMesh& mesh, std::vector<std::uint32_t>& stack, std::size_t& budget,
            const Allowed& allowed) {
  while (!stack.empty() && budget > 0) {
    const std::uint32_t h = stack.back();
    stack.pop_back();
    --budget;
    if (!allowed(h) || !violatesDelaunay(mesh, h) || !mesh.canFlip(h) || flipFolds(mesh, h)) continue;
    mesh.flip(h);
    const std::uint32_t n = EditableMesh::next(h), t = mesh.twin[n];
    for (std::uint32_t e : {h, EditableMesh::previous(n), EditableMesh::next(t), EditableMesh::previous(t)})
      stack.push_back(e);
  }
  stack.clear();
}

bool ownsCorners(const EditableMesh& mesh, const Patches& patches, std::uint32_t patch, std::uint32_t h) {
  return patches.owns(patch, mesh.origin[h]) && patches.owns(patch, mesh.target(h)) &&
         patches.owns(patch, mesh.opposite(h)) && patches.owns(patch, mesh.opposite(mesh.twin[h]));
}

}  // namespace

float facing(const Vec3f (&p)[3], const Vec3f (&n)[3]) {
  const Vec3f normal = (p[1] - p[0]).cross(p[2] - p[0]);
  const float length = normal.length();
  const float longest2 =
      std::max({(p[1] - p[0]).lengthSqr(), (p[2] - p[0]).lengthSqr(), (p[2] - p[1]).lengthSqr()});
  if (!(length > 1e-5f * longest2)) return -1.0f;
  return std::min({normal.dot(n[0]), normal.dot(n[1]), normal.dot(n[2])}) / length;
}

bool facesOutward(const EditableMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Vec3f &p0 = mesh.position[a], &p1 = mesh.position[b], &p2 = mesh.position[c];
  const Vec3f u = p1 - p0, v = p2 - p0, w = p2 - p1;
  const Vec3f normal = u.cross(v);
  const float length2 = normal.lengthSqr();
  const float longest2 = std::max({u.lengthSqr(), v.lengthSqr(), w.lengthSqr()});
  const float worst =
      std::min({normal.dot(mesh.normal[a]), normal.dot(mesh.normal[b]), normal.dot(mesh.normal[c])});
  return worst > 0.0f && worst * worst >= kFacing * kFacing * length2 &&
         length2 > 1e-10f * longest2 * longest2;
}

float worstFacingAt(const EditableMesh& mesh, std::uint32_t v, const Vec3f& at, const Vec3f& atNormal,
                    std::uint32_t except) {
  float worst = 1.0f;
  mesh.around(v, [&](std::uint32_t h) {
    const std::uint32_t b = mesh.target(h), c = mesh.opposite(h);
    if (b == except || c == except) return;
    const Vec3f p[3] = {at, mesh.position[b], mesh.position[c]};
    const Vec3f n[3] = {atNormal, mesh.normal[b], mesh.normal[c]};
    worst = std::min(worst, facing(p, n));
  });
  return worst;
}

float worstFacing(const EditableMesh& mesh, std::uint32_t v, std::uint32_t except) {
  return worstFacingAt(mesh, v, mesh.position[v], mesh.normal[v], except);
}

void flipToDelaunay(EditableMesh& mesh, const std::vector<std::uint32_t>* dirty) {
  std::vector<std::uint32_t> stack;
  std::size_t budget = flipBudget(mesh.halfEdgeCount());
  // Most edges need no flip, which is found out in parallel.
  using Edges = std::vector<std::uint32_t>;
  Edges wrong;
  if (dirty && dirty->size() < mesh.vertexCount() / 4) {
    wrong = gathered<std::uint32_t>(dirty->size(), [&](std::uint32_t i, Edges& found) {
      const std::uint32_t v = (*dirty)[i];
      if (mesh.outgoing[v] == kNone) return;
      mesh.around(v, [&](std::uint32_t h) {
        for (std::uint32_t e : {h, EditableMesh::next(h)}) {
          if (violatesDelaunay(mesh, e)) found.push_back(e);
        }
      });
    });
  } else {
    wrong = gathered<std::uint32_t>(mesh.halfEdgeCount(), [&](std::uint32_t h, Edges& found) {
      if (mesh.alive(h) && h < mesh.twin[h] && violatesDelaunay(mesh, h)) found.push_back(h);
    });
  }
  for (std::uint32_t h : wrong) {
    stack.assign(1, h);
    settle(mesh, stack, budget, [](std::uint32_t) { return true; });
  }
}

void flipToDelaunay(EditableMesh& mesh, const Patches& patches, std::uint32_t patch, std::uint32_t v,
                    std::vector<std::uint32_t>& stack) {
  constexpr std::size_t kMostFlips = 64;
  mesh.around(v, [&](std::uint32_t h) {
    if (violatesDelaunay(mesh, h)) stack.push_back(h);
  });
  std::size_t budget = kMostFlips;
  settle(mesh, stack, budget, [&](std::uint32_t h) { return ownsCorners(mesh, patches, patch, h); });
}

void flipToDelaunay(EditableMesh& mesh, const Patches& patches, std::uint32_t patch) {
  std::vector<std::uint32_t> wrong, stack;
  const std::uint32_t begin = patches.first[patch], end = patches.first[patch + 1];
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t v = patches.vertex[i];
    if (mesh.outgoing[v] == kNone) continue;
    mesh.around(v, [&](std::uint32_t h) {
      if (v < mesh.target(h) && ownsCorners(mesh, patches, patch, h) && violatesDelaunay(mesh, h))
        wrong.push_back(h);
    });
  }
  std::size_t budget = flipBudget(6 * (end - begin));
  for (std::uint32_t h : wrong) {
    stack.assign(1, h);
    settle(mesh, stack, budget, [&](std::uint32_t e) { return ownsCorners(mesh, patches, patch, e); });
  }
}

bool tryCollapse(EditableMesh& mesh, std::uint32_t h, std::vector<std::uint32_t>& freed) {
  const std::uint32_t v = mesh.origin[h], u = mesh.target(h);
  const float now = worstFacingAt(mesh, v, mesh.position[u], mesh.normal[u], u);
  if (now < kFacing && !mayFace(now, worstFacing(mesh, v))) return false;
  if (!mesh.canCollapse(h)) return false;
  mesh.collapse(h, freed);
  return true;
}

void takeScale(EditableMesh& mesh, const LevelSet& phi) {
  if (!phi.scaled()) return;
  mesh.scale.resize(mesh.vertexCount());
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) { mesh.scale[v] = phi.scale(mesh.position[v]); });
}

std::uint32_t splitOnSurface(EditableMesh& mesh, std::uint32_t h, const LevelSet& phi) {
  const std::uint32_t a = mesh.origin[h], b = mesh.target(h), c = mesh.opposite(h),
                      d = mesh.opposite(mesh.twin[h]);
  const Vec3f middle = (mesh.position[a] + mesh.position[b]) * 0.5f;
  Vec3f normal = mesh.normal[a] + mesh.normal[b];
  normal.normalize();
  const float length = (mesh.position[a] - mesh.position[b]).length();
  const float before = std::min(facingOf(mesh, a, b, c), facingOf(mesh, b, a, d));
  const LevelSet::Projection p = phi.project(middle, reachFor(0.5f * length));
  const std::uint32_t m = mesh.splitEdge(h, middle, p.known ? p.normal : normal);
  if (p.known && mayFace(worstFacingAt(mesh, m, p.position, p.normal), before)) mesh.position[m] = p.position;
  if (!mesh.scale.empty()) mesh.scale[m] = phi.scale(mesh.position[m]);
  return m;
}

void splitLongEdges(EditableMesh& mesh, const LevelSet& phi, float longest) {
  const auto length2 = [&](std::uint32_t h) {
    return (mesh.position[mesh.origin[h]] - mesh.position[mesh.target(h)]).lengthSqr();
  };
  constexpr int kRounds =
      32;  // each halves lengths: enough for any ratio of voxel and spacing that fits into memory
  using Edges = std::vector<std::uint32_t>;
  for (int round = 0; round < kRounds; ++round) {
    const auto tooLong = [&](std::uint32_t h) {
      const float most = longest * std::min(mesh.scaleAt(mesh.origin[h]), mesh.scaleAt(mesh.target(h)));
      return length2(h) > most * most;
    };
    const Edges edges = gathered<std::uint32_t>(mesh.halfEdgeCount(), [&](std::uint32_t h, Edges& found) {
      if (mesh.alive(h) && h < mesh.twin[h] && tooLong(h)) found.push_back(h);
    });
    if (edges.empty()) break;
    for (std::uint32_t h : edges) {
      // A split beside it may have made another edge of it.
      if (!tooLong(h)) continue;
      // Only the longest edge of both its triangles is split, so that triangles keep their shape.
      const std::uint32_t t = mesh.twin[h];
      const float own = length2(h);
      const auto longer = [&](std::uint32_t e) { return length2(e) > own; };
      if (longer(EditableMesh::next(h)) || longer(EditableMesh::previous(h)) ||
          longer(EditableMesh::next(t)) || longer(EditableMesh::previous(t)))
        continue;
      splitOnSurface(mesh, h, phi);
    }
  }
}

}  // namespace fluidtex::texture
