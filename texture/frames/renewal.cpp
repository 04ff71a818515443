#include "texture/frames/renewal.h"

#include "numerics/random.h"
#include "texture/labels/fresh.h"
#include "texture/labels/guidance.h"
#include "texture/labels/pieces.h"
#include "texture/labels/slips.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"
#include "texture/orientation/averaged.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr float kSeamWeight = 0.75f;
constexpr float kLostStretch = 4.0f;
constexpr float kSameTexel = 0.7f;     // texels: a proposal this close to the transported label is the same
constexpr float kSlipStretch = 1.15f;  // stretch that closing slips leaves: no reason to renew the same texel
constexpr float kLeastGain = 0.05f;    // least mean decrease of badness for which a piece is accepted
constexpr int kBadnessSweeps = 16;     // of the averaging of badness (averaged.h)
constexpr double kDiscsApart = 2.0 * kDiscShare;  // centres, over the nominal radius
constexpr float kMostYoung = 0.35f;               // share of a disc that may be in a cross-fade
constexpr float kTooYoung =
    0.3f;  // over the nominal radius: no further centre is tried this close to a disc that had more
// Earliest renewal, in units of log keepStretch. Well below 1, since neighbours were laid together and would
// otherwise be renewed together.
constexpr float kEarliest = 0.5f;
// How much texture may stretch during its cross-fade, in units of log keepStretch.
constexpr float kFadesWithin = 1.8f;

bool lost(const SeamModel& model, const Label& label, float trust, std::uint32_t v) {
  if (!believed(trust)) return true;
  if (model.isOriginal(v)) return false;
  return !liesOn(model.image, label.texel) || (isMirrored(label) && !model.image.ways.mirrored);
}

float stretchBadness(const SeamModel& model, const Label& label, float trust, std::uint32_t v) {
  const float amount = std::log(stretch(label));
  return lost(model, label, trust, v) ? std::max(amount, std::log(kLostStretch)) : amount;
}

// Value noise in 0..1 over the exemplar: bilinear between random values on a grid.
float noiseAt(const Vec2f& texel, std::uint64_t seed) {
  constexpr float kCell = 24.0f;  // texels
  const float x = texel[0] / kCell, y = texel[1] / kCell;
  const float i = std::floor(x), j = std::floor(y);
  const auto corner = [&](int di, int dj) {
    return float(randomUnit(
        seed, randomBits(std::uint64_t(std::int64_t(i) + di), std::uint64_t(std::int64_t(j) + dj))));
  };
  const float above = corner(0, 0) + (x - i) * (corner(1, 0) - corner(0, 0));
  const float below = corner(0, 1) + (x - i) * (corner(1, 1) - corner(0, 1));
  return above + (y - j) * (below - above);
}

float badnessAt(const SeamModel& model, const Labels& labels, float trust, std::uint32_t v) {
  return kSeamWeight * seamCostAround(model, labels, v) + stretchBadness(model, labels[v], trust, v) +
         guidanceCost(model.image, model.view.mesh, labels[v].texel, v);
}

}  // namespace

std::vector<float> badness(const SeamModel& model, const Labels& labels, const std::vector<float>& trust) {
  std::vector<float> result(labels.size());
  forEachIndex(result.size(), [&](std::uint32_t v) { result[v] = badnessAt(model, labels, trust[v], v); });
  return result;
}

bool believed(float trust) {
  return trust >= kLowTrust;
}

namespace {

// Region growing: vertices connected to a centre within a distance of it.
class Surroundings {
 public:
  explicit Surroundings(const MeshView& view) : m_view(view), m_stamp(view.mesh.positions.size(), 0) {}

  const std::vector<std::uint32_t>& within(std::uint32_t center, double pixels) {
    const std::vector<Vec3f>& x = m_view.mesh.positions;
    const auto reach = float(pixels * m_view.mesh.spacingAt(center));
    m_found.assign(1, center);
    m_stamp[center] = ++m_current;
    for (std::size_t i = 0; i < m_found.size(); ++i)
      for (const std::uint32_t u : m_view.graph.around(m_found[i])) {
        if (m_stamp[u] == m_current || (x[u] - x[center]).lengthSqr() > reach * reach) continue;
        m_stamp[u] = m_current;
        m_found.push_back(u);
      }
    return m_found;
  }

 private:
  const MeshView& m_view;
  std::vector<std::uint32_t> m_stamp, m_found;
  std::uint32_t m_current = 0;
};

// Round discs leave a third of a plane uncovered. Wanted vertices there join the first disc to reach them
// within `rings` rings; left for later, they would wait until the cross-fades around them have ended.
template <typename Wanted>
void fillBetween(const VertexGraph& graph, int rings, const Wanted& wanted, std::vector<Disc>& discs) {
  std::vector<std::uint8_t> taken(graph.first.size() - 1, 0);
  for (const Disc& disc : discs)
    for (const std::uint32_t v : disc.members) taken[v] = 1;
  std::vector<std::size_t> front(discs.size(), 0);  // start of each disc's outermost ring
  for (int ring = 0; ring < rings; ++ring)
    for (std::size_t d = 0; d < discs.size(); ++d) {
      std::vector<std::uint32_t>& members = discs[d].members;
      const std::size_t end = members.size();
      for (std::size_t i = front[d]; i < end; ++i)
        for (const std::uint32_t u : graph.around(members[i])) {
          if (taken[u] || !wanted(u)) continue;
          taken[u] = 1;
          members.push_back(u);
        }
      front[d] = end;
    }
}

}  // namespace

Wear wearAround(const SeamModel& model, const Labels& labels, const std::vector<float>& trust) {
  const std::vector<float> bad = badness(model, labels, trust);
  std::vector<Vec2f> both(labels.size());
  forEachIndex(labels.size(), [&](std::uint32_t v) {
    both[v] = {bad[v], lost(model, labels[v], trust[v], v) ? 0.0f : std::log(stretch(labels[v]))};
  });
  both = averaged(model.view.graph, std::move(both), kBadnessSweeps,
                  [](const Vec2f& value, std::uint32_t) { return value; });
  Wear wear{std::vector<float>(labels.size()), std::vector<float>(labels.size())};
  forEachIndex(labels.size(),
               [&](std::uint32_t v) { wear.bad[v] = both[v][0], wear.stretch[v] = both[v][1]; });
  return wear;
}

Wear scaled(Wear wear, const std::vector<float>& factor) {
  if (factor.empty()) return wear;
  forEachIndex(factor.size(),
               [&](std::uint32_t v) { wear.bad[v] *= factor[v], wear.stretch[v] *= factor[v]; });
  return wear;
}

double wornShare(const std::vector<Strain>& rates, double seconds, double keepStretch,
                 const std::vector<float>& factor) {
  const double life = (kMostAhead + double(kUrgent)) * std::log(std::max(keepStretch, 1.01));
  const double sum = sumOf(rates.size(), [&](std::uint32_t v) {
    const double times = factor.empty() ? 1.0 : double(factor[v]);
    return std::min(1.0, times * double(largest(rates[v])) * seconds / life);
  });
  return sum / double(std::max<std::size_t>(rates.size(), 1));
}

float fadingSpeed(float strainRate, double keepStretch, double fade) {
  const double most = double(kFadesWithin) * std::log(std::max(keepStretch, 1.01));
  return float(std::max(1.0 / std::max(fade, 1e-3), double(strainRate) / most));
}

std::vector<Disc> worstDiscs(const SeamModel& model, const Labels& labels, const Wear& wear,
                             const std::vector<std::uint8_t>& free, const DiscOptions& options,
                             std::uint64_t seed) {
  const std::size_t count = labels.size();
  const std::vector<float>& bad = wear.bad;
  const auto stays = [&](std::uint32_t v) { return free[v] == 0; };
  const auto kept = float(std::log(options.keepStretch));
  const auto urgent = [&](std::uint32_t v) { return wear.stretch[v] >= kUrgent * kept; };
  std::vector<std::uint32_t> candidates = gathered<std::uint32_t>(count, [&](std::uint32_t v, auto& list) {
    if (free[v] && bad[v] > kept * (kEarliest + (1.0f - kEarliest) * noiseAt(labels[v].texel, seed)))
      list.push_back(v);
  });
  std::sort(candidates.begin(), candidates.end(),
            [&](std::uint32_t a, std::uint32_t b) { return bad[a] > bad[b] || (bad[a] == bad[b] && a < b); });

  std::vector<Disc> discs;
  std::vector<std::uint8_t> near(count, 0);  // no further centre here
  Surroundings surroundings(model.view);
  double covered = 0.0;
  for (const std::uint32_t center : candidates) {
    // A budget below one vertex is none.
    const double budget = urgent(center) ? options.urgentBudget : options.budget;
    if (covered + 1.0 > budget * double(count)) continue;
    if (near[center]) continue;
    Disc disc{center, surroundings.within(center, kDiscShare * options.radius)};
    const auto young = std::count_if(disc.members.begin(), disc.members.end(),
                                     [&](std::uint32_t v) { return stays(v) && bad[v] > 0.0f; });
    if (float(young) > kMostYoung * float(disc.members.size())) {
      for (const std::uint32_t v : surroundings.within(center, double(kTooYoung) * options.radius))
        near[v] = 1;
      continue;
    }
    std::erase_if(disc.members, stays);
    covered += double(disc.members.size());
    for (const std::uint32_t v : surroundings.within(center, kDiscsApart * options.radius)) near[v] = 1;
    discs.push_back(std::move(disc));
  }
  const auto reach = int(std::ceil((kDiscsApart - kDiscShare) * options.radius));
  fillBetween(
      model.view.graph, reach, [&](std::uint32_t v) { return urgent(v) && free[v]; }, discs);
  return discs;
}

std::vector<std::uint8_t> lostLabels(const SeamModel& model, const Labels& labels,
                                     const std::vector<float>& trust) {
  std::vector<std::uint8_t> result(labels.size());
  forEachIndex(labels.size(), [&](std::uint32_t v) { result[v] = lost(model, labels[v], trust[v], v); });
  return result;
}

std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings) {
  std::vector<std::uint32_t> front, next;
  for (std::uint32_t v = 0; v < mask.size(); ++v)
    if (mask[v]) front.push_back(v);
  for (int ring = 0; ring < rings && !front.empty(); ++ring) {
    next.clear();
    for (const std::uint32_t v : front)
      for (const std::uint32_t u : graph.around(v)) {
        if (mask[u]) continue;
        mask[u] = 1;
        next.push_back(u);
      }
    front.swap(next);
  }
  return mask;
}

namespace {

// #V: change of badness where `renewed` is 1: the vertex's own, and its share of the neighbours that stay.
// Proposed labels do not depend on transported ones, so their trust is 1.
std::vector<float> changesOf(const SeamModel& model, const Labels& carried, const Labels& proposed,
                             const std::vector<float>& trust, const std::vector<std::uint8_t>& renewed) {
  const VertexGraph& graph = model.view.graph;
  std::vector<float> change(carried.size(), 0.0f);
  forEachIndex(carried.size(), [&](std::uint32_t v) {
    if (!renewed[v]) return;
    change[v] = badnessAt(model, proposed, 1.0f, v) - badnessAt(model, carried, trust[v], v);
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      const std::uint32_t u = graph.neighbor[h];
      if (renewed[u] || model.slides(v, u)) continue;
      const float rise =
          seamCost(model, proposed[v], carried[u], h) - seamCost(model, carried[v], carried[u], h);
      change[v] += kSeamWeight * rise / float(graph.around(u).size());
    }
  });
  return change;
}

}  // namespace

Labels settle(const SeamModel& model, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, std::vector<std::uint8_t>& renewed,
              const std::vector<float>& factor) {
  const std::size_t count = carried.size();
  Labels result = carried;
  renewed.assign(count, 0);
  forEachIndex(count, [&](std::uint32_t v) {
    const Vec2f difference = texelDifference(model.image, proposed[v].texel, carried[v].texel);
    if (difference.lengthSqr() <= kSameTexel * kSameTexel &&
        stretch(carried[v]) <= std::max(kSlipStretch, stretch(proposed[v]) + 0.05f))
      return;
    renewed[v] = 1;
    result[v] = proposed[v];
  });
  closeSlips(model, renewed, result);  // before judging: pieces are judged as they will be

  const std::vector<float> change = changesOf(model, carried, result, trust, renewed);
  const std::vector<std::uint8_t> offered = renewed;
  forEachPiece(model.view.graph, offered, [&](const std::vector<std::uint32_t>& piece) {
    double sum = 0.0;
    for (const std::uint32_t v : piece) sum += double(change[v]) * (factor.empty() ? 1.0 : double(factor[v]));
    if (sum < -double(kLeastGain) * double(piece.size())) return;
    for (const std::uint32_t v : piece) {
      renewed[v] = 0;
      result[v] = carried[v];
    }
  });
  return result;
}

}  // namespace fluidtex::texture
