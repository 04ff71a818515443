#include "texture/look_ahead.h"

#include "texture/complex.h"
#include "texture/fresh.h"
#include "texture/parallel.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr int kBlurSweeps = 24;
// Lengths that change more than this from one frame to the next (log) tell of other points, not of the flow.
constexpr float kMostPerFrame = 1.0f;

// A strain, times how far it is believed.
struct Weighted {
  float mean = 0.0f, weight = 0.0f;
  Complexf deviator{0.0f, 0.0f};
};

// The lengths before, squared and over those now, are n.C n for edges of direction n; the strain is -log(C) / 2.
Weighted fittedStrain(const MeshView& view, const std::vector<Vec3f>& previous, std::uint32_t v) {
  const std::vector<Vec3f>& now = view.mesh.positions;
  Eigen::Matrix3f system = Eigen::Matrix3f::Zero();
  Eigen::Vector3f right = Eigen::Vector3f::Zero();
  for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
    const std::uint32_t u = view.graph.neighbor[h];
    const Complexf edge = view.connection.edge[h];
    const float length = std::abs(edge), length2 = (now[u] - now[v]).lengthSqr();
    if (!(length > 0.0f) || !(length2 > 0.0f)) return {};
    const Complexf n = edge / length;
    const Eigen::Vector3f row(n.real() * n.real(), 2.0f * n.real() * n.imag(), n.imag() * n.imag());
    system += row * row.transpose();
    right += row * ((previous[u] - previous[v]).lengthSqr() / length2);
  }
  Eigen::LDLT<Eigen::Matrix3f> solver(system);
  if (solver.info() != Eigen::Success || !(solver.vectorD().minCoeff() > 1e-3f)) return {};
  const Eigen::Vector3f c = solver.solve(right);
  const float mean = 0.5f * (c[0] + c[2]);
  const Complexf deviator(0.5f * (c[0] - c[2]), c[1]);
  const float size = std::abs(deviator), least = mean - size, most = mean + size;
  if (!(least > std::exp(-2.0f * kMostPerFrame)) || !(most < std::exp(2.0f * kMostPerFrame))) return {};
  const float high = -0.5f * std::log(least), low = -0.5f * std::log(most);
  const float spread = size > 1e-12f ? -0.5f * (high - low) / size : 0.0f;
  return {0.5f * (high + low), 1.0f, deviator * spread};
}

std::vector<Weighted> blurred(const MeshView& view, std::vector<Weighted> value) {
  std::vector<Weighted> next(value.size());
  for (int sweep = 0; sweep < kBlurSweeps; ++sweep) {
    forEachIndex(value.size(), [&](std::uint32_t v) {
      Weighted sum = value[v];
      for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
        const Weighted& other = value[view.graph.neighbor[h]];
        const Complexf& turn = view.connection.rotation[h];
        sum.mean += other.mean;
        sum.weight += other.weight;
        sum.deviator += product(product(turn, turn), other.deviator);
      }
      const float share = 1.0f / float(view.graph.around(v).size() + 1);
      next[v] = {sum.mean * share, sum.weight * share, sum.deviator * share};
    });
    value.swap(next);
  }
  return value;
}

Strain opposite(const Strain& strain) {
  return {-strain.mean, -strain.deviator};
}

// J exp(strain), column by column.
Label multiplied(const Label& label, const Strain& strain) {
  const Complexf x = strained(strain, {1.0f, 0.0f}), y = strained(strain, {0.0f, 1.0f});
  const std::array<float, 4>& j = label.jacobian;
  return {label.texel,
          {j[0] * x.real() + j[1] * x.imag(), j[0] * y.real() + j[1] * y.imag(),
           j[2] * x.real() + j[3] * x.imag(), j[2] * y.real() + j[3] * y.imag()}};
}

}  // namespace

Complexf strained(const Strain& strain, const Complexf& x) {
  const float size = std::abs(strain.deviator);
  const float along = size > 1e-6f ? std::sinh(size) / size : 1.0f;
  return std::exp(strain.mean) * (std::cosh(size) * x + along * product(strain.deviator, std::conj(x)));
}

float largest(const Strain& strain) {
  return std::abs(strain.mean) + std::abs(strain.deviator);
}

std::vector<Strain> strainRates(const MeshView& view, const std::vector<Vec3f>& previous,
                                const std::vector<float>& trust, double seconds) {
  std::vector<Strain> result(previous.size());
  if (!(seconds > 0.0)) return result;
  std::vector<Weighted> fitted(previous.size());
  forEachIndex(fitted.size(), [&](std::uint32_t v) {
    bool known = trust[v] >= kLowTrust;
    for (const std::uint32_t u : view.graph.around(v)) known = known && trust[u] >= kLowTrust;
    if (known) fitted[v] = fittedStrain(view, previous, v);
  });
  fitted = blurred(view, std::move(fitted));
  forEachIndex(fitted.size(), [&](std::uint32_t v) {
    const Weighted& f = fitted[v];
    if (!(f.weight > 1e-6f)) return;
    const float scale = 1.0f / (f.weight * float(seconds));
    result[v] = {f.mean * scale, f.deviator * scale};
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
  Connection result = view.connection;
  forEachIndex(strain.size(), [&](std::uint32_t v) {
    for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
      const Strain& other = strain[view.graph.neighbor[h]];
      const Complexf turn = product(view.connection.rotation[h], view.connection.rotation[h]);
      const Strain mean{0.5f * (strain[v].mean + other.mean),
                        0.5f * (strain[v].deviator + product(turn, other.deviator))};
      result.edge[h] = strained(mean, view.connection.edge[h]);
    }
  });
  return result;
}

Labels strained(Labels labels, const std::vector<Strain>& strain) {
  forEachIndex(labels.size(), [&](std::uint32_t v) { labels[v] = multiplied(labels[v], opposite(strain[v])); });
  return labels;
}

Labels unstrained(Labels labels, const std::vector<Strain>& strain) {
  forEachIndex(labels.size(), [&](std::uint32_t v) { labels[v] = multiplied(labels[v], strain[v]); });
  return labels;
}

}  // namespace fluidtex::texture
