// Texture optimisation of one level at one window width [Kwatra07 sec. V-B, Kwatra05], EM-like. E-step: each
// neighbourhood finds its best matching exemplar window. M-step: the surface becomes their weighted average.
// At the end each vertex copies a texel of one of the windows over it. Minimises
//
//   E(s) = sum over windows p of m_p phi(D_p / m_p) + sum over vertices k of f_k |s_k - c_k|^2
//
// the first sum being equation (1) of the paper with a robust norm, the second its equation (2).
//
// D_p: squared difference of surface and matched window over the vertex neighbourhood, weighted by the
// Gaussian fall-off g. m_p: sum of g. phi(x) = (2 / r) D0 (x / D0)^(r/2) is the robust norm |.|^r; D0 is the
// mean of D_p / m_p at the start; below D0 / 100 phi is continued by its tangent.
// E never rises while the window width stays. phi is concave, so the average with weights phi'(D_p / m_p)
// lowers E (majorise-minimise: iteratively reweighted least squares). A match is replaced only by one of
// smaller D_p. The pull of the histogram weights away from that average is limited accordingly.
#pragma once

#include "texture/exemplar/texel_image.h"
#include "texture/labels/labels.h"
#include "texture/neighborhood/neighborhood.h"
#include "texture/optimize/histogram.h"
#include "texture/options.h"
#include "texture/search/search.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Soft constraint to transported values.
struct Constraint {
  Values value;               // #V: c
  std::vector<float> weight;  // #V: f_k in units of the mean total weight of windows at a vertex
};

struct Level {
  MeshView view;
  const TexelImage& image;
  const HistogramTarget& histogram;
  Constraint constraint;             // empty: none
  std::vector<std::uint8_t> wanted;  // #V, 1: the vertex may change; empty: all may
};

struct Pass {
  int window = 9;
  int iterations = 1;
  // Candidates of each iteration: the best windows in `probes` leaves of the table's tree, and `similar`
  // windows from its k-coherence lists, as far as it has them. Null: neither.
  const SearchTable* table = nullptr;
  int probes = 4;
  int similar = 0;
  bool startFromLabels = true;  // initial matches from labels at the windows' centres; else from the tree
  bool copyCores = true;        // at the end copy texels and their labels; else keep the average
  std::uint64_t seed = 0;       // keys the random numbers of the pass
};

struct State {
  Values value;    // #V: s
  Labels labels;   // #V
  Values average;  // #V: the last average, before texels were copied
};

// E at the start of a pass, then after the M-step of each iteration.
using EnergyTrace = std::vector<double>;

// Runs one pass. Precondition: state.value is filled, and state.labels too if pass.startFromLabels.
EnergyTrace optimize(const Level& level, const Pass& pass, const SynthesisOptions& options, State& state);

// #V, weights of the soft constraint: f (1 + min(3, |grad c| / its mean)) trust, the gradient being the rms
// difference over a vertex's edges.
std::vector<float> constraintWeights(const MeshView& view, const Values& value,
                                     const std::vector<float>& trust, double f);

}  // namespace fluidtex::texture
