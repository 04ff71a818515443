#include "texture/orientation/tangent_field.h"

#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"

#include <algorithm>
#include <utility>

namespace fluidtex::texture {
namespace {

// Fixes the order of summation, and so the last digits.
constexpr std::size_t kTermsAtOnce = 1024;

double dot(const std::vector<Complexf>& a, const std::vector<Complexf>& b) {
  return sumOf(
      a.size(),
      [&](std::uint32_t v) { return double(a[v].real()) * b[v].real() + double(a[v].imag()) * b[v].imag(); },
      kTermsAtOnce);
}

}  // namespace

Complexf power(const Complexf& z, int n) {
  Complexf result = z;
  for (int i = 1; i < n; ++i) result = product(result, z);
  return result;
}

FieldGraph fieldGraph(const VertexGraph& graph, const Connection& connection, int symmetry,
                      std::vector<float> stiffness) {
  FieldGraph field{graph, connection.rotation, std::move(stiffness)};
  if (symmetry > 1) {
    forEachIndex(field.rotation.size(),
                 [&](std::uint32_t h) { field.rotation[h] = power(field.rotation[h], symmetry); });
  }
  return field;
}

void solveField(const FieldGraph& field, const std::vector<float>& hold, const std::vector<Complexf>& right,
                int mostSteps, double tolerance, std::vector<Complexf>& values) {
  const VertexGraph& graph = field.graph;
  const std::size_t count = values.size();
  const auto stiffnessOf = [&](std::uint32_t v, std::uint32_t u) {
    return field.stiffness.empty() ? 1.0f : 0.5f * (field.stiffness[v] + field.stiffness[u]);
  };
  std::vector<float> diagonal(count);
  forEachIndex(count, [&](std::uint32_t v) {
    float sum = hold[v];
    for (const std::uint32_t u : graph.around(v)) sum += stiffnessOf(v, u);
    diagonal[v] = sum;
  });
  const auto apply = [&](const std::vector<Complexf>& x, std::vector<Complexf>& out) {
    forEachIndex(count, [&](std::uint32_t v) {
      Complexf sum = diagonal[v] * x[v];
      for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h];
        sum -= stiffnessOf(v, u) * product(field.rotation[h], x[u]);
      }
      out[v] = sum;
    });
  };

  std::vector<Complexf> residual(count), scaled(count), image(count);
  apply(values, image);
  forEachIndex(count, [&](std::uint32_t v) {
    residual[v] = right[v] - image[v];
    scaled[v] = residual[v] / diagonal[v];
  });
  std::vector<Complexf> direction = scaled;
  const auto done = [&] { return dot(scaled, scaled) <= tolerance * tolerance * dot(values, values); };
  double size = dot(residual, scaled);
  for (int step = 0; step < mostSteps && !done(); ++step) {
    apply(direction, image);
    const double curvature = dot(direction, image);
    if (!(curvature > 0.0)) break;
    const auto along = static_cast<float>(size / curvature);
    forEachIndex(count, [&](std::uint32_t v) {
      values[v] += along * direction[v];
      residual[v] -= along * image[v];
      scaled[v] = residual[v] / diagonal[v];
    });
    const double earlier = std::exchange(size, dot(residual, scaled));
    const auto keep = static_cast<float>(size / earlier);
    forEachIndex(count, [&](std::uint32_t v) { direction[v] = scaled[v] + keep * direction[v]; });
  }
}

Complexf average(const FieldGraph& field, const std::vector<Complexf>& values, std::uint32_t v) {
  const std::uint32_t begin = field.graph.first[v], end = field.graph.first[v + 1];
  Complexf sum = values[v];
  for (std::uint32_t h = begin; h < end; ++h)
    sum += product(field.rotation[h], values[field.graph.neighbor[h]]);
  return sum / float(end - begin + 1);
}

void normalise(std::vector<Complexf>& values) {
  forEachIndex(values.size(), [&](std::uint32_t v) {
    const float length = std::abs(values[v]);
    values[v] = length > 1e-30f ? values[v] / length : Complexf(1.0f, 0.0f);
  });
}

}  // namespace fluidtex::texture
