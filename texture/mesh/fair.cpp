// Position based dynamics after Mueller, Heidelberger, Hennix, Ratcliff (2007); smoothing without shrinkage
// after Taubin, "A signal processing approach to fair surface design" (1995).
#include "texture/mesh/fair.h"

#include "texture/mesh/mesh_faults.h"
#include "texture/mesh/round_drops.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

using openvdb::Vec3d;

// Targets beyond the limits, so that faults stay within these when their neighbours move.
constexpr double kOpen = 0.12, kBlunt = 0.42;

Vec3d at(const EditableMesh& mesh, std::uint32_t v) {
  return Vec3d(mesh.position[v]);
}

class Fairer {
 public:
  Fairer(EditableMesh& mesh, const LevelSet& phi) : m_mesh(mesh), m_phi(phi) {}

  void run() {
    const Faults left = attempt();
    if (left.none()) return;
    // A knot that splits have only refined is coarsened, and gets one more try.
    coarsen(around(left, kKnot));
    attempt();
  }

 private:
  static constexpr int kKnot = 6;  // rings

  // Returns the faults that are left.
  Faults attempt() {
    constexpr int kRounds = 40, kSweeps = 40, kHopeless = 12;
    constexpr std::size_t kSplitsPerFault = 8, kSomeSplits = 64;
    constexpr int kRefined = 4;                     // rounds, until all edges around are split
    constexpr double kShrink = 0.5, kKeep = -0.53;  // second half of a pass of smooth()
    Faults faults = faultsOf(m_mesh);
    if (faults.none()) return faults;
    if (roundOffDrops(m_mesh, m_phi, around(faults, 0))) faults = faultsOf(m_mesh);
    // Where there is little hope, as in noise, time and number of vertices need a bound.
    m_splitsLeft = kSomeSplits + kSplitsPerFault * countOf(faults);
    std::size_t fewest = countOf(faults);
    int best = 0;
    for (int round = 0; round < kRounds && round - best <= kHopeless && !faults.none(); ++round) {
      // Shrinking untangles what is crumpled; what is thin must not shrink.
      const std::vector<std::uint32_t> region = around(faults, 2);
      const bool refined = round > 1 && round % kRefined == 1;
      smooth(region, refined ? 10 : round == 0 ? 6 : 2, round == 1 ? kShrink : kKeep);
      const std::vector<std::uint32_t> watched = withNeighbors(region);
      faults = faultsAt(m_mesh, watched);
      for (int sweep = 0; sweep < kSweeps && !faults.none(); ++sweep) {
        open(faults);
        faults = faultsAt(m_mesh, watched);
      }
      if (!faults.none()) {
        tidy(faults);
        faults = faultsAt(m_mesh, watched);
        if (round > 0 && round % kRefined == 0) {
          refineAll(faults);
        } else if (round > 0) {
          refine(faults);
        }
      }
      faults = faultsAt(m_mesh, touched());
      if (countOf(faults) < fewest) fewest = countOf(faults), best = round;
    }
    return faults;
  }

  static std::size_t countOf(const Faults& faults) { return faults.folds.size() + faults.spikes.size(); }

  std::vector<std::uint32_t> withNeighbors(const std::vector<std::uint32_t>& vertices) {
    m_listed.resize(m_mesh.vertexCount(), 0);
    std::vector<std::uint32_t> result;
    const auto list = [&](std::uint32_t v) {
      if (!m_listed[v]) result.push_back(v);
      m_listed[v] = 1;
    };
    for (std::uint32_t v : vertices) {
      if (m_mesh.outgoing[v] == kNone) continue;
      list(v);
      m_mesh.around(v, [&](std::uint32_t h) { list(m_mesh.target(h)); });
    }
    for (std::uint32_t v : result) m_listed[v] = 0;
    std::sort(result.begin(), result.end());
    return result;
  }

  // Vertices of the faults and so many rings around them.
  std::vector<std::uint32_t> around(const Faults& faults, int rings) {
    std::vector<std::uint32_t> result = faults.spikes;
    for (std::uint32_t h : faults.folds)
      for (std::uint32_t side : {h, m_mesh.twin[h]}) {
        result.push_back(m_mesh.origin[side]);
        result.push_back(m_mesh.opposite(side));
      }
    for (int ring = 0; ring < rings; ++ring) result = withNeighbors(result);
    return result;
  }

  // All vertices moved so far, and their neighbours.
  std::vector<std::uint32_t> touched() {
    std::sort(m_moved.begin(), m_moved.end());
    m_moved.erase(std::unique(m_moved.begin(), m_moved.end()), m_moved.end());
    return withNeighbors(withNeighbors(m_moved));
  }

  void move(std::uint32_t v, const Vec3d& way) {
    m_moved.push_back(v);
    m_mesh.position[v] = Vec3f(at(m_mesh, v) + way);
    const Vec3f gradient = m_phi.sample(m_mesh.position[v]).gradient;
    const float length = gradient.length();
    m_mesh.normal[v] = length > 0.0f ? gradient / length : Vec3f(0.0f);
    if (m_phi.scaled()) m_mesh.scale[v] = m_phi.scale(m_mesh.position[v]);
  }

  // Taubin smoothing: each vertex moves towards the mean of its neighbours, and then by `second`.
  void smooth(const std::vector<std::uint32_t>& region, int passes, double second) {
    constexpr double kFirst = 0.5;
    std::vector<Vec3d> ways(region.size());
    for (int pass = 0; pass < 2 * passes; ++pass) {
      for (std::size_t i = 0; i < region.size(); ++i) ways[i] = ringOf(m_mesh, region[i]).toMean;
      for (std::size_t i = 0; i < region.size(); ++i)
        move(region[i], ways[i] * (pass % 2 == 0 ? kFirst : second));
    }
  }

  // One iteration of the constraints; edge lengths are evened out on the way.
  void open(const Faults& faults) {
    constexpr double kEven = 0.15;
    for (std::uint32_t v : around(faults, 1)) {
      const Vec3d way = ringOf(m_mesh, v).toMean, n(meshNormal(m_mesh, v));
      move(v, (way - n * n.dot(way)) * kEven);
    }
    for (std::uint32_t h : faults.folds) unfold(h);
    for (std::uint32_t v : faults.spikes) blunt(v);
  }

  Vec3d inwards(std::uint32_t h) const {
    const Vec3d a = at(m_mesh, m_mesh.origin[h]);
    return (at(m_mesh, m_mesh.opposite(h)) - a).cross(at(m_mesh, m_mesh.target(h)) - a);
  }

  // Rotates the two triangles of an edge apart.
  void unfold(std::uint32_t h) {
    constexpr double kStep = 0.6;
    const std::uint32_t t = m_mesh.twin[h];
    const std::uint32_t a = m_mesh.origin[h], b = m_mesh.origin[t], c = m_mesh.opposite(h),
                        d = m_mesh.opposite(t);
    Vec3d u = at(m_mesh, b) - at(m_mesh, a);
    if (!u.normalize()) return;
    const auto height = [&](std::uint32_t v) {
      const Vec3d from = at(m_mesh, v) - at(m_mesh, a);
      return from - u * from.dot(u);
    };
    const Vec3d hc = height(c), hd = height(d);
    const double lc = hc.length(), ld = hd.length();
    if (lc <= 0.0 || ld <= 0.0) return;
    const Vec3d ec = hc / lc, ed = hd / ld;
    const double angle = std::acos(std::clamp(ec.dot(ed), -1.0, 1.0)), wanted = std::acos(-kOpen);
    if (angle >= wanted) return;
    // Perpendicular to the height, away from the other one; inwards where both coincide.
    const auto away = [&](const Vec3d& own, const Vec3d& other, std::uint32_t side) {
      Vec3d w = own * own.dot(other) - other;
      if (w.lengthSqr() < 1e-12) w = inwards(side);
      w.normalize();
      return w;
    };
    const double step = 0.5 * kStep * (wanted - angle);
    const Vec3d moveC = away(ec, ed, h) * (lc * step), moveD = away(ed, ec, t) * (ld * step);
    const Vec3d back = (moveC + moveD) * -0.25;
    move(c, moveC + back);
    move(d, moveD + back);
    move(a, back);
    move(b, back);
  }

  // Moves a vertex towards the mean of its neighbours, and these slightly the other way.
  void blunt(std::uint32_t v) {
    constexpr double kStep = 0.5;
    const Ring ring = ringOf(m_mesh, v);
    const double off = ring.toMean.length();
    if (off <= kBlunt * ring.edge) return;
    const Vec3d way = ring.toMean * (kStep * (1.0 - kBlunt * ring.edge / off));
    move(v, way);
    m_mesh.around(v, [&](std::uint32_t h) { move(m_mesh.target(h), way * (-0.5 / ring.count)); });
  }

  // Largest turn at the edges of two adjacent triangles.
  double worstTurn(std::uint32_t h) const {
    const std::uint32_t t = m_mesh.twin[h];
    double worst = turn(m_mesh, h);
    for (std::uint32_t e :
         {EditableMesh::next(h), EditableMesh::previous(h), EditableMesh::next(t), EditableMesh::previous(t)})
      worst = std::min(worst, turn(m_mesh, e));
    return worst;
  }

  // Collapses edges of a region that are much shorter than those of the whole mesh.
  void coarsen(const std::vector<std::uint32_t>& region) {
    constexpr double kShort = 0.6;
    double sum = 0.0, count = 0.0;
    for (std::uint32_t h = 0; h < m_mesh.origin.size(); ++h) {
      if (!m_mesh.alive(h)) continue;
      sum += std::sqrt(length2(h));
      count += 1.0;
    }
    const double least = kShort * sum / std::max(count, 1.0);
    for (std::uint32_t v : region) {
      // Each vertex absorbs its nearest neighbours, one after the other.
      for (int n = 0; n < 8 && m_mesh.outgoing[v] != kNone; ++n) {
        std::uint32_t shortest = kNone;
        m_mesh.around(v, [&](std::uint32_t h) {
          if (length2(h) < least * least && m_mesh.canCollapse(h) &&
              (shortest == kNone || length2(h) < length2(shortest)))
            shortest = h;
        });
        if (shortest == kNone) break;
        m_moved.push_back(m_mesh.target(shortest));
        m_mesh.collapse(shortest);
      }
    }
  }

  // Collapses edges much shorter than those around, and flips edges where that reduces folding.
  void tidy(const Faults& faults) {
    constexpr double kShort = 0.15;  // of the longest mean edge at a neighbour
    for (std::uint32_t v : around(faults, 1)) {
      if (m_mesh.outgoing[v] == kNone) continue;
      double beside = 0.0;
      std::uint32_t shortest = m_mesh.outgoing[v];
      m_mesh.around(v, [&](std::uint32_t h) {
        beside = std::max(beside, ringOf(m_mesh, m_mesh.target(h)).edge);
        if (length2(h) < length2(shortest)) shortest = h;
      });
      if (length2(shortest) < kShort * kShort * beside * beside && m_mesh.canCollapse(shortest)) {
        m_moved.push_back(m_mesh.target(shortest));
        m_mesh.collapse(shortest);
      }
    }
    for (std::uint32_t h : faults.folds) {
      if (!m_mesh.alive(h) || turn(m_mesh, h) >= kFolded || !m_mesh.canFlip(h)) continue;
      const double before = worstTurn(h);
      m_mesh.flip(h);
      const std::uint32_t turned = EditableMesh::next(h);
      if (worstTurn(turned) <= before) m_mesh.flip(turned);  // back
    }
  }

  void split(std::uint32_t h) {
    if (m_splitsLeft == 0) return;
    --m_splitsLeft;
    const std::uint32_t a = m_mesh.origin[h], b = m_mesh.target(h);
    const Vec3f middle = (m_mesh.position[a] + m_mesh.position[b]) * 0.5f;
    Vec3f normal = m_mesh.normal[a] + m_mesh.normal[b];
    normal.normalize();
    const std::uint32_t m = m_mesh.splitEdge(h, middle, normal);
    if (!m_mesh.scale.empty()) m_mesh.scale[m] = m_phi.scale(middle);
  }

  double length2(std::uint32_t h) const {
    return (at(m_mesh, m_mesh.target(h)) - at(m_mesh, m_mesh.origin[h])).lengthSqr();
  }

  // Splits where the turn needs more vertices: at a fold the longer of each triangle's two other edges, at a
  // spike the longest edge.
  void refine(const Faults& faults) {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t h : faults.folds) {
      ends.push_back(m_mesh.origin[h]);
      ends.push_back(m_mesh.target(h));
    }
    for (std::size_t k = 0; k < faults.folds.size(); ++k) {
      const std::uint32_t h = faults.folds[k];
      if (m_mesh.origin[h] != ends[2 * k] || m_mesh.target(h) != ends[2 * k + 1] ||
          turn(m_mesh, h) >= kFolded)
        continue;  // a split beside it has changed it
      for (std::uint32_t side : {h, m_mesh.twin[h]}) {
        const std::uint32_t n = EditableMesh::next(side), p = EditableMesh::previous(side);
        split(length2(n) >= length2(p) ? n : p);
      }
    }
    for (std::uint32_t v : faults.spikes) {
      if (!sticksOut(m_mesh, v)) continue;
      std::uint32_t longest = m_mesh.outgoing[v];
      m_mesh.around(v, [&](std::uint32_t h) {
        if (length2(h) > length2(longest)) longest = h;
      });
      split(longest);
    }
  }

  // The same with all edges around split, longest first, where refine() was not enough.
  void refineAll(const Faults& faults) {
    constexpr double kLong = 0.7;  // of the mean edge at its ends
    std::vector<std::pair<double, std::uint32_t>> edges;
    for (std::uint32_t v : around(faults, 1)) {
      m_mesh.around(v, [&](std::uint32_t h) {
        const std::uint32_t u = m_mesh.target(h);
        const double most = 0.5 * kLong * (ringOf(m_mesh, v).edge + ringOf(m_mesh, u).edge);
        if (v < u && length2(h) > most * most) edges.emplace_back(-length2(h), h);
      });
    }
    std::sort(edges.begin(), edges.end());
    for (const auto& [length, h] : edges)
      if (length2(h) >= -0.999 * length) split(h);  // a split beside it may have made another edge of it
  }

  EditableMesh& m_mesh;
  const LevelSet& m_phi;
  std::vector<std::uint8_t> m_listed;  // #V, 0 between calls
  std::vector<std::uint32_t> m_moved;
  std::size_t m_splitsLeft = 0;
};

}  // namespace

void fair(EditableMesh& mesh, const LevelSet& phi) {
  Fairer(mesh, phi).run();
}

}  // namespace fluidtex::texture
