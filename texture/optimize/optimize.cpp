#include "texture/optimize/optimize.h"

#include "texture/labels/guidance.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"
#include "texture/optimize/matches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

namespace fluidtex::texture {
namespace {

// phi of optimize.h.
struct RobustNorm {
  double exponent = 2.0, mean = 1.0;
  static constexpr double kFloor = 0.01;

  double slope(double x) const { return std::pow(std::max(x / mean, kFloor), 0.5 * exponent - 1.0); }
  double operator()(double x) const {
    const double low = kFloor * mean, at = std::max(x, low);
    const double value = 2.0 / exponent * mean * std::pow(at / mean, 0.5 * exponent);
    return x >= low ? value : value - slope(low) * (low - x);
  }
};

// Working state of one pass.
struct Run {
  const Level& level;
  const Pass& pass;
  const SynthesisOptions& options;
  State& state;
  Windows windows;
  Overlaps byVertex;
  RobustNorm norm;
  std::vector<float> held;  // f_k in units of the energy; empty without constraint
  Histogram expected;

  bool free(std::uint32_t v) const { return level.wanted.empty() || level.wanted[v]; }
  Float8 texel(std::uint32_t i) const {  // prediction of overlap i for its vertex
    const Vec2f at = windows.texelAt(byVertex.window[i], windows.neighborhoods.offset[byVertex.entry[i]]);
    return level.image.sampleInside(at[0], at[1]);
  }
};

double energy(const Run& run) {
  const double matching = sumOf(run.windows.match.size(), [&](std::size_t p) {
    return double(run.windows.mass[p]) * run.norm(run.windows.distance[p]);
  });
  if (run.held.empty()) return matching;
  return matching + sumOf(run.held.size(), [&](std::size_t v) {
           const Float8 d = run.state.value[v] - run.level.constraint.value[v];
           return double(run.held[v]) * double(sum8(d * d));
         });
}

// True up to rounding, of the sums, and of colours by about 1e-5.
[[maybe_unused]] bool neverRose(const EnergyTrace& trace, const std::vector<float>& mass) {
  const double whole = sumOf(mass.size(), [&](std::size_t p) { return mass[p]; });
  return trace.back() <= trace[trace.size() - 2] * (1.0 + 1e-6) + 1e-10 * whole;
}

// M-step. `room`: by how much the reweighted average may exceed the plain one in the majorising quadratic,
// beyond what the plain one gains over the present values.
void average(Run& run, double room) {
  const std::size_t count = run.state.value.size();
  const bool reweigh = run.options.histogram > 0.0;
  std::vector<float> slope(run.windows.match.size());
  for (std::size_t p = 0; p < slope.size(); ++p) slope[p] = float(run.norm.slope(run.windows.distance[p]));
  std::optional<HistogramWeights> texelWeight;
  if (reweigh)
    texelWeight.emplace(run.level.histogram, run.expected,
                        histogramOf(run.level.histogram, run.state.value, run.level.image.channels),
                        run.level.image, run.options.histogram, run.byVertex.entry.size());

  Values plain = run.state.value, reweighed = reweigh ? run.state.value : Values{};
  std::vector<float> total(count, 0.0f);
  forEachIndex(count, [&](std::uint32_t v) {
    if (!run.free(v)) return;
    Float8 sum{}, weightedSum{};
    float weight = 0.0f, weightedWeight = 0.0f;
    for (std::uint32_t i = run.byVertex.first[v]; i < run.byVertex.first[v + 1]; ++i) {
      const std::uint32_t p = run.byVertex.window[i], entry = run.byVertex.entry[i];
      const float w = slope[p] * run.windows.falloff[entry];
      const Vec2f at = run.windows.texelAt(p, run.windows.neighborhoods.offset[entry]);
      const Float8 texel = run.level.image.sampleInside(at[0], at[1]);
      sum += w * texel;
      weight += w;
      if (reweigh) {
        const float h = w * (*texelWeight)[run.level.image.nearest(at[0], at[1])];
        weightedSum += h * texel;
        weightedWeight += h;
      }
    }
    if (!run.held.empty()) {
      const float f = run.held[v];
      sum += f * run.level.constraint.value[v];
      weight += f;
      weightedSum += f * run.level.constraint.value[v];
      weightedWeight += f;
    }
    if (!(weight > 0.0f)) return;
    total[v] = weight;
    plain[v] = sum / weight;
    if (reweigh && weightedWeight > 0.0f) reweighed[v] = weightedSum / weightedWeight;
  });
  // The guidance channel is given; only the others are unknowns.
  holdGuidance(run.level.image, run.level.view.mesh, plain);
  if (reweigh) holdGuidance(run.level.image, run.level.view.mesh, reweighed);
  if (!reweigh) {
    run.state.value.swap(plain);
    return;
  }

  const auto distanceFrom = [&](const Values& values) {
    return sumOf(count, [&](std::size_t v) {
      const Float8 d = values[v] - plain[v];
      return double(total[v]) * double(sum8(d * d));
    });
  };
  // A small margin for rounding.
  const double gain = 0.999 * (distanceFrom(run.state.value) + std::max(room, 0.0)),
               cost = distanceFrom(reweighed);
  const auto share = float(cost > gain ? std::sqrt(gain / cost) : 1.0);
  forEachIndex(count, [&](std::uint32_t v) {
    if (total[v] > 0.0f) run.state.value[v] = plain[v] + share * (reweighed[v] - plain[v]);
  });
}

// Every vertex copies a texel from one of the windows that overlap it: close to the average, and close to the
// window's centre.
void copyCores(Run& run) {
  const auto core = float(run.options.core);
  forEachIndex(run.state.value.size(), [&](std::uint32_t v) {
    if (!run.free(v)) return;
    float best = std::numeric_limits<float>::max();
    std::uint32_t chosen = 0;
    for (std::uint32_t i = run.byVertex.first[v]; i < run.byVertex.first[v + 1]; ++i) {
      const float edge = 1.0f - run.windows.falloff[run.byVertex.entry[i]];
      float score = core * edge * edge;
      if (run.pass.copyCores) {
        const Float8 d = run.texel(i) - run.state.value[v];
        score += sum8(d * d);
      } else {
        score = edge;  // only for the label: the window with the nearest centre
      }
      if (score < best) best = score, chosen = i;
    }
    if (best == std::numeric_limits<float>::max()) return;
    const std::uint32_t p = run.byVertex.window[chosen], entry = run.byVertex.entry[chosen];
    run.state.labels[v] =
        unstretched(run.level.image.brought(run.windows.texelAt(p, run.windows.neighborhoods.offset[entry])),
                    seenFrom(layOf(run.windows.way[p]), run.windows.neighborhoods.turn[entry]));
    if (run.pass.copyCores) run.state.value[v] = run.level.image.sample(run.state.labels[v].texel);
  });
}

}  // namespace

EnergyTrace optimize(const Level& level, const Pass& pass, const SynthesisOptions& options, State& state) {
  const std::size_t count = level.view.mesh.positions.size();
  Run run{level, pass, options, state, makeWindows(level, pass), {}, {}, {}, {}};
  Windows& windows = run.windows;
  if (windows.match.empty()) return {};
  run.byVertex = overlaps(windows.neighborhoods, count);
  run.expected = expectedHistogram(level.histogram, level.image, windows.demand);
  holdGuidance(level.image, level.view.mesh, state.value);
  state.labels.resize(count);

  if (pass.startFromLabels) {
    const float reach = 0.5f * float(pass.window - 1);
    for (std::size_t p = 0; p < windows.match.size(); ++p) {
      const Label& label = state.labels[windows.neighborhoods.center[p]];
      windows.match[p] = level.image.centerFor(label.texel, reach);
      windows.way[p] = nearestWay(windows.ways, layOf(label, windows.ways));
    }
    measureMatches(level.image, state.value, windows);
  } else {
    findFirstMatches(level, pass, state.value, windows);
  }

  run.norm.exponent = options.robustExponent;
  const double mean = sumOf(windows.distance.size(), [&](std::size_t p) { return windows.distance[p]; }) /
                      double(windows.distance.size());
  run.norm.mean = std::max(mean, 1e-12);
  if (!level.constraint.value.empty()) {
    // At the mean distance phi' is 1, so that the mean total weight of windows is that of the fall-offs.
    const double together = sumOf(windows.mass.size(), [&](std::size_t p) { return windows.mass[p]; });
    std::size_t covered = 0;
    for (std::size_t v = 0; v < count; ++v) covered += run.byVertex.first[v + 1] > run.byVertex.first[v];
    const auto unit = float(together / double(std::max<std::size_t>(covered, 1)));
    run.held.resize(count);
    forEachIndex(count, [&](std::uint32_t v) {
      run.held[v] = run.free(v) ? unit * level.constraint.weight[v] : 0.0f;
    });
  }

  EnergyTrace trace{energy(run)};
  for (int iteration = 0; iteration < pass.iterations; ++iteration) {
    improveMatches(level, pass, iteration, options.usage, state.value, windows);
    average(run, trace.back() - energy(run));
    measureMatches(level.image, state.value, windows);
    trace.push_back(energy(run));
    assert(neverRose(trace, windows.mass));
  }
  state.average = state.value;
  copyCores(run);
  holdGuidance(level.image, level.view.mesh, state.value);
  return trace;
}

std::vector<float> constraintWeights(const MeshView& view, const Values& value,
                                     const std::vector<float>& trust, double f) {
  const std::size_t count = value.size();
  std::vector<float> gradient(count);
  forEachIndex(count, [&](std::uint32_t v) {
    float sum = 0.0f;
    const auto around = view.graph.around(v);
    for (const std::uint32_t u : around) {
      const Float8 d = value[u] - value[v];
      sum += sum8(d * d);
    }
    gradient[v] = std::sqrt(sum / float(around.size()));
  });
  const double mean =
      sumOf(count, [&](std::size_t v) { return gradient[v]; }) / double(std::max<std::size_t>(count, 1));
  std::vector<float> weight(count);
  forEachIndex(count, [&](std::uint32_t v) {
    const double steep = mean > 0.0 ? std::min(3.0, gradient[v] / mean) : 0.0;
    weight[v] = float(f * (1.0 + steep)) * trust[v];
  });
  return weight;
}

}  // namespace fluidtex::texture
