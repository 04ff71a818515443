#include "texture/frames/look_ahead.h"

#include "numerics/lanes.h"
#include "texture/labels/fresh.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"
#include "texture/orientation/averaged.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr int kStrainSweeps = 24;
// Edges whose length changes by more than this in a frame (log) are taken for connections of unrelated
// points.
constexpr float kMostPerFrame = 1.0f;

// A strain times its confidence, and the confidence.
using Weighted = Float4;
enum : int { kMean, kWeight, kDeviatorReal, kDeviatorImag };

// Squared former edge lengths over the present ones are n.C n for edges of direction n, that is m + d.q with
// q = n^2 as a complex number, m and d the mean and deviator of C. The strain is -log(C) / 2.
Weighted fittedStrain(const MeshView& view, const std::vector<Vec3f>& previous, std::uint32_t v) {
  const std::vector<Vec3f>& now = view.mesh.positions;
  float count = 0.0f, ratios = 0.0f, xx = 0.0f, xy = 0.0f, yy = 0.0f;
  Complexf sum(0.0f), right(0.0f);
  for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
    const std::uint32_t u = view.graph.neighbor[h];
    const Complexf& edge = view.connection.edge[h];
    const float flat2 = std::norm(edge), length2 = (now[u] - now[v]).lengthSqr();
    if (!(flat2 > 0.0f) || !(length2 > 0.0f)) return Weighted{};
    const Complexf q = product(edge, edge) / flat2;
    const float ratio = (previous[u] - previous[v]).lengthSqr() / length2;
    count += 1.0f, ratios += ratio, sum += q, right += q * ratio;
    xx += q.real() * q.real(), xy += q.real() * q.imag(), yy += q.imag() * q.imag();
  }
  if (count < 3.0f) return Weighted{};
  const Complexf center = sum / count;
  xx -= center.real() * sum.real(), xy -= center.real() * sum.imag(), yy -= center.imag() * sum.imag();
  right -= center * ratios;
  const float det = xx * yy - xy * xy;
  if (!(det > 1e-3f)) return Weighted{};  // edges span no more than two directions
  const Complexf deviator((right.real() * yy - right.imag() * xy) / det,
                          (right.imag() * xx - right.real() * xy) / det);
  const float mean = ratios / count - center.real() * deviator.real() - center.imag() * deviator.imag();
  const float size = std::abs(deviator), least = mean - size, most = mean + size;
  if (!(least > std::exp(-2.0f * kMostPerFrame)) || !(most < std::exp(2.0f * kMostPerFrame)))
    return Weighted{};
  const float high = -0.5f * std::log(least), low = -0.5f * std::log(most);
  const float spread = size > 1e-12f ? -0.5f * (high - low) / size : 0.0f;
  return Weighted{0.5f * (high + low), 1.0f, deviator.real() * spread, deviator.imag() * spread};
}

std::vector<Weighted> blurred(const MeshView& view, std::vector<Weighted> value) {
  const std::vector<Complexf>& rotation = view.connection.rotation;
  std::vector<Complexf> turn(rotation.size());  // rotation of a deviator
  forEachIndex(turn.size(), [&](std::uint32_t h) { turn[h] = product(rotation[h], rotation[h]); });
  return averaged(view.graph, std::move(value), kStrainSweeps, [&](const Weighted& w, std::uint32_t h) {
    const float re = turn[h].real(), im = turn[h].imag();
    return w * Weighted{1.0f, 1.0f, re, re} +
           Weighted{0.0f, 0.0f, w[kDeviatorImag], w[kDeviatorReal]} * Weighted{0.0f, 0.0f, -im, im};
  });
}

// exp(strain): the linear map x -> same * x + mirrored * conj(x), a symmetric matrix.
struct StretchMap {
  float same = 1.0f;
  Complexf mirrored{0.0f, 0.0f};

  Complexf operator()(const Complexf& x) const { return same * x + product(mirrored, std::conj(x)); }
};

StretchMap mapOf(const Strain& strain) {
  const float size = std::abs(strain.deviator), scale = std::exp(strain.mean);
  const float along = size > 1e-6f ? std::sinh(size) / size : 1.0f;
  return {scale * std::cosh(size), scale * along * strain.deviator};
}

Strain opposite(const Strain& strain) {
  return {-strain.mean, -strain.deviator};
}

// J exp(strain).
Label multiplied(const Label& label, const Strain& strain) {
  const StretchMap map = mapOf(strain);
  const float xx = map.same + map.mirrored.real(), xy = map.mirrored.imag(),
              yy = map.same - map.mirrored.real();
  const std::array<float, 4>& j = label.jacobian;
  return {label.texel,
          {j[0] * xx + j[1] * xy, j[0] * xy + j[1] * yy, j[2] * xx + j[3] * xy, j[2] * xy + j[3] * yy}};
}

}  // namespace

Complexf strained(const Strain& strain, const Complexf& x) {
  return mapOf(strain)(x);
}

float largest(const Strain& strain) {
  return std::abs(strain.mean) + std::abs(strain.deviator);
}

std::vector<Strain> strainRates(const MeshView& view, const std::vector<Vec3f>& previous,
                                const std::vector<float>& trust, double seconds) {
  std::vector<Strain> result(previous.size());
  if (!(seconds > 0.0)) return result;
  std::vector<Weighted> fitted(previous.size(), Weighted{});
  forEachIndex(fitted.size(), [&](std::uint32_t v) {
    bool known = trust[v] >= kLowTrust;
    for (const std::uint32_t u : view.graph.around(v)) known = known && trust[u] >= kLowTrust;
    if (known) fitted[v] = fittedStrain(view, previous, v);
  });
  fitted = blurred(view, std::move(fitted));
  forEachIndex(fitted.size(), [&](std::uint32_t v) {
    const Weighted& f = fitted[v];
    if (!(f[kWeight] > 1e-6f)) return;
    const float scale = 1.0f / (f[kWeight] * float(seconds));
    result[v] = {f[kMean] * scale, {f[kDeviatorReal] * scale, f[kDeviatorImag] * scale}};
  });
  return result;
}

std::vector<Strain> strainAhead(std::vector<Strain> rates, double horizon, double most) {
  forEachIndex(rates.size(), [&](std::uint32_t v) {
    const float scale = std::min(float(horizon), float(most) / std::max(largest(rates[v]), 1e-12f));
    rates[v] = {rates[v].mean * scale, rates[v].deviator * scale};
  });
  return rates;
}

Connection strained(const MeshView& view, const std::vector<Strain>& strain) {
  std::vector<StretchMap> maps(strain.size());
  forEachIndex(strain.size(), [&](std::uint32_t v) { maps[v] = mapOf(strain[v]); });
  Connection result = view.connection;
  forEachIndex(strain.size(), [&](std::uint32_t v) {
    for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
      const StretchMap& other = maps[view.graph.neighbor[h]];
      const Complexf turn = product(view.connection.rotation[h], view.connection.rotation[h]);
      const StretchMap mean{0.5f * (maps[v].same + other.same),
                            0.5f * (maps[v].mirrored + product(turn, other.mirrored))};
      result.edge[h] = mean(view.connection.edge[h]);
    }
  });
  return result;
}

Labels strained(Labels labels, const std::vector<Strain>& strain) {
  forEachIndex(labels.size(),
               [&](std::uint32_t v) { labels[v] = multiplied(labels[v], opposite(strain[v])); });
  return labels;
}

Labels unstrained(Labels labels, const std::vector<Strain>& strain) {
  forEachIndex(labels.size(), [&](std::uint32_t v) { labels[v] = multiplied(labels[v], strain[v]); });
  return labels;
}

}  // namespace fluidtex::texture
