// Y. Boykov, O. Veksler, R. Zabih, "Fast approximate energy minimization via graph cuts" (2001), with the
// seam cost of Kwatra, Schoedl, Essa, Turk, Bobick, "Graphcut textures" (2003).
#include "texture/labels/label_expansion.h"

#include "numerics/random.h"
#include "texture/labels/guidance.h"
#include "texture/labels/min_cut.h"
#include "texture/labels/usage.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

// Lengths in pixels.
constexpr float kDisc = 18.0f;      // radius of a disc, the domain of one cut
constexpr float kCenters = 10.0f;   // selection radius of the centres, which are then about 15 apart
constexpr float kSeamReach = 9.0f;  // a disc is visited if a seam lies within this distance of its centre
constexpr float kProposalsFrom = 12.0f;  // distance of the other proposals from the centre
constexpr int kProposals = 5;            // the centre's own label included
constexpr float kSame = 0.5f;            // texels: labels this close are the same

constexpr float kLeastGain = 0.9f;    // per cut, in units of the difference of random texels
constexpr float kMostStretch = 1.2f;  // labels stretched more are offered unstretched
constexpr std::size_t kChunk = 2048;  // discs flattened at once

// A proposed label, at the disc's centre and in its axes.
struct Proposal {
  Label label;
  Label at(const Vec2f& l, const Complexf& turn) const {
    const std::array<float, 4>& j = label.jacobian;
    const float c = turn.real(), s = turn.imag();
    return {label.at(Complexf(l[0], l[1])),
            {j[0] * c + j[1] * s, j[1] * c - j[0] * s, j[2] * c + j[3] * s, j[3] * c - j[2] * s}};
  }
};

// A vertex's label continued to the centre, which lies at -l in the vertex's surroundings.
Proposal broughtToCenter(const Label& label, const Ways& ways, const Vec2f& l, const Complexf& turn) {
  const Label used = stretch(label) > kMostStretch ? unstretched(label.texel, layOf(label, ways)) : label;
  const Complexf back = std::conj(turn);  // from the centre's axes to the vertex's
  const std::array<float, 4>& j = used.jacobian;
  const float c = back.real(), s = back.imag();
  return {{used.at(product(back, Complexf(-l[0], -l[1]))),
           {j[0] * c + j[1] * s, j[1] * c - j[0] * s, j[2] * c + j[3] * s, j[3] * c - j[2] * s}}};
}

// Seam costs of an edge: neither end takes the proposal, the second does, the first does.
struct SeamCosts {
  float keepKeep = 0.0f, keepTake = 0.0f, takeKeep = 0.0f;
};

// Per-thread workspace, reused from disc to disc.
struct Workspace {
  explicit Workspace(std::size_t vertexCount) : slot(vertexCount, kNone) {}
  std::vector<std::uint32_t> slot;   // #V: index among the free members, or kNone; reset after each disc
  std::vector<std::uint32_t> entry;  // per member: its entry of the neighbourhood
  Labels proposed;
  Values value;                            // the image at the proposed labels
  std::vector<float> present;              // present seam cost of each edge, in the order of forEachEdge()
  std::vector<float> labelNow, labelThen;  // unary costs of the members: keep, take
  std::vector<float> ownNow, ownThen;      // the same with the seams to fixed vertices
  std::vector<SeamCosts> seams;            // of the edges that may change, in the order of forEachEdge()
  std::vector<std::uint8_t> differs;
  MinCut cut;
};

struct Change {
  Vec2f from, to;
};

class Expansion {
 public:
  Expansion(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
            std::uint64_t seed, Labels& labels)
      : m_model(model),
        m_terms(terms),
        m_free(free),
        m_seed(seed),
        m_labels(labels),
        m_value(lookUp(model.image, labels)),
        m_usage(model.image, std::max(8, std::min(model.image.width, model.image.height) / 12), labels.size(),
                demandOn(model.image, model.view.mesh)),
        m_workspaces([count = labels.size()] { return Workspace(count); }) {
    for (const Label& label : labels) m_usage.add(label.texel, 1.0f);
  }

  double run() {
    std::vector<std::uint32_t> centers = selectCenters(m_model.view, kCenters, m_free);
    std::sort(centers.begin(), centers.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::make_pair(randomBits(m_seed, a), a) < std::make_pair(randomBits(m_seed, b), b);
    });
    for (std::size_t begin = 0; begin < centers.size(); begin += kChunk) {
      const std::size_t end = std::min(centers.size(), begin + kChunk);
      m_discs = buildNeighborhoods(
          m_model.view, 2 * int(kDisc) + 1,
          {centers.begin() + std::ptrdiff_t(begin), centers.begin() + std::ptrdiff_t(end)});
      for (const std::vector<std::uint32_t>& batch : batches()) runBatch(batch);
    }
    return m_cuts > 0 ? double(m_taken) / double(m_cuts) : 0.0;
  }

 private:
  bool isFree(std::uint32_t v) const { return m_free.empty() || m_free[v]; }

  // Colours the discs greedily in their order: discs of one batch do not touch, and each comes after the
  // earlier ones that it touches.
  std::vector<std::vector<std::uint32_t>> batches() const {
    std::vector<std::vector<std::uint32_t>> result;
    std::vector<std::uint16_t> next(m_labels.size(), 0);  // #V: first batch that no disc at the vertex is in
    const auto touched = [&](std::uint32_t p, const auto& body) {
      for (std::uint32_t i = m_discs.first[p]; i < m_discs.first[p + 1]; ++i) {
        body(m_discs.vertex[i]);
        for (const std::uint32_t u : m_model.view.graph.around(m_discs.vertex[i])) body(u);
      }
    };
    for (std::uint32_t p = 0; p < m_discs.size(); ++p) {
      std::uint16_t batch = 0;
      touched(p, [&](std::uint32_t v) { batch = std::max(batch, next[v]); });
      touched(p, [&](std::uint32_t v) { next[v] = std::uint16_t(batch + 1); });
      if (batch >= result.size()) result.resize(std::size_t(batch) + 1);
      result[batch].push_back(p);
    }
    return result;
  }

  void runBatch(const std::vector<std::uint32_t>& batch) {
    std::vector<std::vector<Change>> changes(batch.size());
    std::vector<std::array<int, 2>> counts(batch.size());
    tbb::parallel_for(std::size_t(0), batch.size(), [&](std::size_t i) {
      counts[i] = runDisc(batch[i], m_workspaces.local(), changes[i]);
    });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      m_cuts += std::size_t(counts[i][0]), m_taken += std::size_t(counts[i][1]);
      for (const Change& change : changes[i]) {
        m_usage.add(change.from, -1.0f);
        m_usage.add(change.to, 1.0f);
      }
    }
  }

  // Cuts all proposals of one disc. Returns the numbers of cuts made and taken.
  std::array<int, 2> runDisc(std::uint32_t p, Workspace& work, std::vector<Change>& changes) {
    std::array<int, 2> counts{0, 0};
    work.entry.clear();
    for (std::uint32_t i = m_discs.first[p]; i < m_discs.first[p + 1]; ++i)
      if (isFree(m_discs.vertex[i]) && m_discs.offset[i].lengthSqr() < kDisc * kDisc) work.entry.push_back(i);
    if (!seamNearCenter(work)) return counts;
    for (std::uint32_t i = 0; i < work.entry.size(); ++i) work.slot[m_discs.vertex[work.entry[i]]] = i;
    std::array<Proposal, kProposals> proposals;
    const std::size_t count = propose(p, proposals);
    bool changed = true;
    for (std::size_t i = 0; i < count; ++i) {
      if (changed) countPresent(work);
      changed = cut(proposals[i], work, changes);
      ++counts[0];
      counts[1] += changed;
    }
    for (const std::uint32_t entry : work.entry) work.slot[m_discs.vertex[entry]] = kNone;
    return counts;
  }

  bool seamNearCenter(const Workspace& work) const {
    for (const std::uint32_t entry : work.entry) {
      if (m_discs.offset[entry].lengthSqr() > kSeamReach * kSeamReach) continue;
      const std::uint32_t v = m_discs.vertex[entry];
      for (std::uint32_t h = m_model.view.graph.first[v]; h < m_model.view.graph.first[v + 1]; ++h)
        if (!continues(m_model, m_labels[v], m_labels[m_model.view.graph.neighbor[h]], h)) return true;
    }
    return false;
  }

  // Labels of the centre and of the vertices nearest to four places around it, without duplicates.
  std::size_t propose(std::uint32_t p, std::array<Proposal, kProposals>& proposals) const {
    std::size_t count = 0;
    const auto offer = [&](std::uint32_t entry) {
      const Proposal proposal = broughtToCenter(m_labels[m_discs.vertex[entry]], m_model.image.ways,
                                                m_discs.offset[entry], m_discs.turn[entry]);
      for (std::size_t i = 0; i < count; ++i)
        if (texelDifference(m_model.image, proposals[i].label.texel, proposal.label.texel).length() <
            kCoherent)
          return;
      proposals[count++] = proposal;
    };
    offer(m_discs.first[p]);
    const float start = 6.2832f * float(randomUnit(m_seed, std::uint64_t(m_discs.center[p]) + (1ull << 40)));
    for (int k = 0; k < kProposals - 1; ++k) {
      const float angle = start + float(M_PI_2) * float(k);
      const Vec2f place(kProposalsFrom * std::cos(angle), kProposalsFrom * std::sin(angle));
      std::uint32_t best = m_discs.first[p];
      for (std::uint32_t i = m_discs.first[p]; i < m_discs.first[p + 1]; ++i)
        if ((m_discs.offset[i] - place).lengthSqr() < (m_discs.offset[best] - place).lengthSqr()) best = i;
      offer(best);
    }
    return count;
  }

  float ownCost(const Label& label, const Float8& value, std::uint32_t v) const {
    return labelCost(m_model, m_terms, label, value, v) + m_terms.usage * (m_usage.at(label.texel) - 1.0f);
  }

  // Costs of the disc with its present labels.
  void countPresent(Workspace& work) const {
    work.labelNow.clear(), work.present.clear();
    for (const std::uint32_t entry : work.entry) {
      const std::uint32_t v = m_discs.vertex[entry];
      work.labelNow.push_back(ownCost(m_labels[v], m_value[v], v));
    }
    forEachEdge(work, [&](std::uint32_t, std::uint32_t, std::uint32_t v, std::uint32_t u, std::uint32_t h) {
      work.present.push_back(seamCost(m_model, m_labels[v], m_value[v], m_labels[u], m_value[u], h));
    });
  }

  bool cut(const Proposal& proposal, Workspace& work, std::vector<Change>& changes) {
    const TexelImage& image = m_model.image;
    const std::size_t count = work.entry.size();
    work.proposed.resize(count);
    work.differs.assign(count, 0);
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t entry = work.entry[i], v = m_discs.vertex[entry];
      Label label = proposal.at(m_discs.offset[entry], m_discs.turn[entry]);
      const Vec2f inside = image.brought(label.texel);
      const bool lost = !image.toroidal && (inside - label.texel).lengthSqr() > 0.25f;
      label.texel = inside;
      const bool same = texelDifference(image, label.texel, m_labels[v].texel).lengthSqr() < kSame * kSame;
      work.differs[i] = !lost && !same;
      work.proposed[i] = work.differs[i] ? label : m_labels[v];
      any = any || work.differs[i];
    }
    if (!any) return false;

    work.cut.reset(count);
    work.value.resize(count);
    work.labelThen.assign(count, 0.0f);
    double now = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!work.differs[i]) continue;
      work.value[i] = image.sample(work.proposed[i].texel);
      work.labelThen[i] = ownCost(work.proposed[i], work.value[i], m_discs.vertex[work.entry[i]]);
      now += double(work.labelNow[i]);
    }
    work.ownNow = work.labelNow, work.ownThen = work.labelThen;
    work.seams.clear();
    const float* present = work.present.data();
    forEachEdge(
        work, [&](std::uint32_t i, std::uint32_t j, std::uint32_t v, std::uint32_t u, std::uint32_t h) {
          SeamCosts costs{*present++, 0.0f, 0.0f};
          const bool first = work.differs[i], second = j != kNone && work.differs[j];
          if (!first && !second) return;
          if (first)
            costs.takeKeep = seamCost(m_model, work.proposed[i], work.value[i], m_labels[u], m_value[u], h);
          if (second)
            costs.keepTake = seamCost(m_model, m_labels[v], m_value[v], work.proposed[j], work.value[j], h);
          now += double(costs.keepKeep);
          if (first && second)
            addPair(i, j, costs, work);
          else if (first)
            work.ownNow[i] += costs.keepKeep, work.ownThen[i] += costs.takeKeep;
          else
            work.ownNow[j] += costs.keepKeep, work.ownThen[j] += costs.keepTake;
          work.seams.push_back(costs);
        });
    for (std::uint32_t i = 0; i < count; ++i) {
      const float least = std::min(work.ownNow[i], work.ownThen[i]);
      if (work.differs[i]) work.cut.addOwn(i, work.ownNow[i] - least, work.ownThen[i] - least);
    }
    work.cut.solve();
    return settleCut(now, work, changes);
  }

  // Splits a pair's costs into unary costs and one arc of the graph. Where both ends take, there is no seam:
  // the label is continued. Seam costs are a metric except for the tolerance of kCoherent; where the triangle
  // inequality fails, the mixed terms are overestimated, which at worst keeps a label.
  static void addPair(std::uint32_t i, std::uint32_t j, const SeamCosts& costs, Workspace& work) {
    // With x = 1 where an end takes: keepKeep + x_i (takeKeep - keepKeep) - x_j takeKeep + (1 - x_i) x_j
    // mixed.
    work.ownNow[i] += costs.keepKeep;
    work.ownThen[i] += costs.takeKeep;
    work.ownNow[j] += costs.takeKeep;
    const float mixed = costs.keepTake + costs.takeKeep - costs.keepKeep;
    if (mixed > 0.0f) work.cut.addPair(i, j, mixed, 0.0f);
  }

  // Calls body(i, j, v, u, h) once for each edge h, from v to u, with a member at an end: i is the index of v
  // among the members, j that of u or kNone.
  template <typename Body>
  void forEachEdge(const Workspace& work, const Body& body) const {
    const VertexGraph& graph = m_model.view.graph;
    for (std::uint32_t i = 0; i < work.entry.size(); ++i) {
      const std::uint32_t v = m_discs.vertex[work.entry[i]];
      for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h], j = work.slot[u];
        if (j == kNone || j >= i) body(i, j, v, u, h);
      }
    }
  }

  // Applies the change if the cost falls by enough. Seams between two vertices that take are included here.
  bool settleCut(double now, Workspace& work, std::vector<Change>& changes) {
    const auto takes = [&](std::uint32_t i) { return work.differs[i] && work.cut.takes(i); };
    bool any = false;
    double then = 0.0;
    for (std::uint32_t i = 0; i < work.entry.size(); ++i) {
      any = any || takes(i);
      if (work.differs[i]) then += double(takes(i) ? work.labelThen[i] : work.labelNow[i]);
    }
    if (!any) return false;
    const SeamCosts* costs = work.seams.data();
    forEachEdge(work, [&](std::uint32_t i, std::uint32_t j, std::uint32_t, std::uint32_t, std::uint32_t h) {
      if (!work.differs[i] && !(j != kNone && work.differs[j])) return;
      const bool first = takes(i), second = j != kNone && takes(j);
      then += double(first && second ? seamCost(m_model, work.proposed[i], work.value[i], work.proposed[j],
                                                work.value[j], h)
                     : first         ? costs->takeKeep
                     : second        ? costs->keepTake
                                     : costs->keepKeep);
      ++costs;
    });
    if (then > now - double(kLeastGain)) return false;
    for (std::uint32_t i = 0; i < work.entry.size(); ++i) {
      if (!takes(i)) continue;
      const std::uint32_t v = m_discs.vertex[work.entry[i]];
      changes.push_back({m_labels[v].texel, work.proposed[i].texel});
      m_labels[v] = work.proposed[i];
      m_value[v] = work.value[i];
    }
    return true;
  }

  const SeamModel& m_model;
  const LabelTerms& m_terms;
  const std::vector<std::uint8_t>& m_free;
  std::uint64_t m_seed;
  Labels& m_labels;
  Values m_value;  // the image at the labels
  Usage m_usage;
  Neighborhoods m_discs;  // of the present chunk
  tbb::enumerable_thread_specific<Workspace> m_workspaces;
  std::size_t m_cuts = 0, m_taken = 0;
};

}  // namespace

double expandLabels(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
                    std::uint64_t seed, Labels& labels) {
  return Expansion(model, terms, free, seed, labels).run();
}

}  // namespace fluidtex::texture
