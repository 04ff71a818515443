// The optimisation of one level and one window width [Kwatra07 sec. V-B, Kwatra05]: windows of the exemplar
// are matched to the surface (E-step), the surface becomes their weighted average (M-step), and in the end
// each vertex copies a texel of one of them.
//
//   E(s) = sum over windows p of m_p phi(D_p / m_p) + sum over vertices k of f_k |s_k - c_k|^2
//
// D_p: squared difference of the surface and the matched window over the vertex neighbourhood, under the
// Gaussian fall-off g; m_p: the sum of g; phi(x) = (2 / r) D0 (x / D0)^(r/2) for the robust |.|^r, D0 the
// mean of D_p / m_p at the start. phi is continued by its tangent below a hundredth of D0. It is concave, so
// that the average with the weights phi'(D_p / m_p) lowers E (majorise-minimise, the usual iteratively
// reweighted least squares). A match is replaced only by one with a smaller D_p. The histogram's reweighting
// of the average is drawn back towards the plain average as far as needed. So E never rises while the
// window's width stays.
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

// What is carried from earlier frames and held to.
struct Constraint {
  Values value;               // #V: c
  std::vector<float> weight;  // #V: f_k in units of the mean weight of all windows together
};

struct Level {
  MeshView view;
  const TexelImage& image;
  const HistogramTarget& histogram;
  Constraint constraint;             // empty: none
  std::vector<std::uint8_t> wanted;  // #V: vertices that may change; empty: all
};

struct Pass {
  int window = 9;
  int iterations = 1;
  // What the table is asked for in every iteration: the windows of `probes` leaves of its tree, and of
  // `similar` windows like the best so far (as far as it has lists). Null: neither.
  const SearchTable* table = nullptr;
  int probes = 4;
  int similar = 0;
  bool startFromLabels = true;  // matches start from the labels of the windows' centres; else from the tree
  bool copyCores = true;   // at the end take labels and look the values up at them; else keep the average
  std::uint64_t seed = 0;  // keys this pass's random numbers
};

struct State {
  Values value;    // #V: s
  Labels labels;   // #V
  Values average;  // #V: the last average before cores were copied
};

// E of the pass after each half: at the start, then after the M-step of each iteration.
using EnergyTrace = std::vector<double>;

// Runs one pass over a state whose values (and labels, where started from) are filled.
EnergyTrace optimize(const Level& level, const Pass& pass, const SynthesisOptions& options, State& state);

// c's weights from softConstraint f: f (1 + min(3, |grad c| / its mean)) trust, the gradient taken over a
// vertex's edges.
std::vector<float> constraintWeights(const MeshView& view, const Values& value,
                                     const std::vector<float>& trust, double f);

}  // namespace fluidtex::texture
