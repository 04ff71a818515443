#include "texture/mesh/adjust.h"

#include "texture/loops/parallel.h"
#include "texture/mesh/remesh.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Size of the gap that an edge crosses: its length, or the larger circumcircle of its triangles. Independent
// of the diagonal chosen between four corners of a rectangle.
float gap(const EditableMesh& mesh, std::uint32_t h, float ownLength) {
  float widest = ownLength;
  for (std::uint32_t side : {h, mesh.twin[h]}) {
    const Vec3f c = mesh.position[mesh.opposite(side)];
    const Vec3f u = mesh.position[mesh.origin[side]] - c, v = mesh.position[mesh.target(side)] - c;
    const float area2 = u.cross(v).length();
    if (area2 > 0.0f) widest = std::max(widest, ownLength * u.length() * v.length() / area2);
  }
  return widest;
}

struct Candidate {
  float length;  // mean edge lengths
  std::uint32_t halfEdge;
  std::uint32_t a, b;
};

bool shorter(const Candidate& x, const Candidate& y) {
  return x.length != y.length ? x.length < y.length : x.halfEdge < y.halfEdge;
}

bool longer(const Candidate& x, const Candidate& y) {
  return x.length != y.length ? x.length > y.length : x.halfEdge > y.halfEdge;
}

// Sorts, and drops candidates that are there for the number only, beyond as many as it needs.
template <typename Before>
void keepFirst(std::vector<Candidate>& candidates, double wanted, float limit, const Before& before) {
  constexpr double kSpare = 2.0;    // some are skipped, since something changed beside them
  constexpr double kMany = 1000.0;  // so many are taken as they lie in memory; what is skipped, the next time
  const Candidate atLimit{limit, 0, 0, 0};
  const auto must = std::partition(candidates.begin(), candidates.end(),
                                   [&](const Candidate& c) { return before(c, atLimit); });
  const auto required = std::size_t(must - candidates.begin());
  const bool many = wanted > kMany;
  const auto count =
      std::max(required, std::size_t(wanted > 0.0 ? (many ? wanted : kSpare * wanted + 1.0) : 0.0));
  if (count < candidates.size()) {
    std::nth_element(candidates.begin(), candidates.begin() + std::ptrdiff_t(count), candidates.end(),
                     before);
    candidates.erase(candidates.begin() + std::ptrdiff_t(count), candidates.end());
  }
  if (many) {
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& x, const Candidate& y) { return x.halfEdge < y.halfEdge; });
  } else {
    std::sort(candidates.begin(), candidates.end(), before);
  }
}

}  // namespace

std::vector<std::uint32_t> adjustNumber(EditableMesh& mesh, const LevelSet& phi, const AdjustOptions& options,
                                        const std::vector<std::uint32_t>* moved) {
  // Mean edge lengths. Points that were even in the last frame get a margin, so that nothing flickers at the
  // limits.
  const float tooShort = options.settled ? 0.6f : 0.63f, tooLong = options.settled ? 1.8f : 1.7f;
  constexpr float kMaybeLong = 1.4f;     // shorter edges cross no gap
  constexpr std::size_t kAtOnce = 4096;  // of a sum
  const double alive = sumOf(
      mesh.vertexCount(), [&](std::uint32_t v) { return mesh.outgoing[v] != kNone ? 1.0 : 0.0; }, kAtOnce);
  // Only what exceeds the slack: a steadily growing surface changes a little on every frame.
  const double tolerated = options.slack * options.points;
  double toRemove = std::max(0.0, alive - options.points - tolerated),
         toAdd = std::max(0.0, options.points - tolerated - alive);
  const bool many = toRemove >= 1.0, few = toAdd >= 1.0;
  // Only these are touched for the sake of the number: of a few more than are needed.
  constexpr double kFew = 0.004;
  const float justShort = toRemove < kFew * options.points ? 0.8f : 0.95f,
              justLong = toAdd < kFew * options.points ? 1.25f : 1.1f;

  using Candidates = std::vector<Candidate>;
  const float shortLimit = many ? justShort : tooShort, longLimit = few ? justLong : tooLong;
  const float perEdge2 = 1.0f / (options.edge * options.edge);
  const float shortLimit2 = shortLimit * shortLimit,
              longLimit2 = std::min(longLimit, kMaybeLong) * std::min(longLimit, kMaybeLong);
  const auto judge = [&](std::uint32_t h, Candidates& found) {
    const std::uint32_t a = mesh.origin[h], b = mesh.target(h);
    const float scale = 0.5f * (mesh.scaleAt(a) + mesh.scaleAt(b));
    const float l2 = (mesh.position[a] - mesh.position[b]).lengthSqr() * perEdge2 / (scale * scale);
    if (l2 >= shortLimit2 && l2 <= longLimit2) return;
    const float l = std::sqrt(l2);
    if (l2 < shortLimit2) {
      found.push_back({l, h, a, b});
      return;
    }
    const float across = l > kMaybeLong ? gap(mesh, h, l) : l;
    if (across > longLimit) found.push_back({across, h, a, b});
  };
  Candidates shortest;
  if (moved && !many && !few) {
    shortest = gathered<Candidate>(moved->size(), [&](std::uint32_t i, Candidates& found) {
      if (mesh.outgoing[(*moved)[i]] != kNone)
        mesh.around((*moved)[i], [&](std::uint32_t h) { judge(std::min(h, mesh.twin[h]), found); });
    });
  } else {
    shortest = gathered<Candidate>(mesh.halfEdgeCount(), [&](std::uint32_t h, Candidates& found) {
      if (h < mesh.twin[h] && mesh.alive(h)) judge(h, found);
    });
  }
  // No edge is in both, since shortLimit < longLimit.
  const auto firstLong = std::stable_partition(shortest.begin(), shortest.end(),
                                               [&](const Candidate& c) { return c.length < shortLimit; });
  Candidates longest(firstLong, shortest.end());
  shortest.erase(firstLong, shortest.end());
  keepFirst(shortest, toRemove, tooShort, shorter);
  keepFirst(longest, toAdd, tooLong, longer);

  std::vector<std::uint32_t> changed;
  std::vector<std::uint8_t> touched;
  if (!shortest.empty() || !longest.empty()) touched.assign(mesh.vertexCount(), 0);
  const auto same = [&](const Candidate& c) {  // the candidate's half-edge is still the edge it was
    return mesh.alive(c.halfEdge) && mesh.origin[c.halfEdge] == c.a && mesh.target(c.halfEdge) == c.b &&
           !touched[c.a] && !touched[c.b];
  };
  const auto touch = [&](std::uint32_t v) {
    mesh.around(v, [&](std::uint32_t h) {
      touched[mesh.target(h)] = 1;
      changed.push_back(mesh.target(h));
    });
    touched[v] = 1;
    changed.push_back(v);
  };
  for (const Candidate& c : shortest) {
    if (c.length >= tooShort && toRemove < 1.0) break;
    if (!same(c)) continue;
    if (tryCollapse(mesh, c.halfEdge)) {
      touch(c.b);
    } else if (tryCollapse(mesh, mesh.twin[c.halfEdge])) {
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
    touch(m);
    toAdd -= 1.0;
  }
  return changed;
}

}  // namespace fluidtex::texture
