#include "transport/trust.h"

#include "texture/labels/labels.h"
#include "texture/loops/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace fluidtex::transport {
namespace {

constexpr float kMuchStretch = 2.0f, kLeastForStretch = 0.6f;
// Deviation between neighbours, in spacings (or edges, where these are longer).
constexpr float kUsualJump = 0.5f, kLargeJump = 1.5f;

void lower(float& value, float to) {
  std::atomic_ref<float> shared(value);
  float now = shared.load(std::memory_order_relaxed);
  while (to < now && !shared.compare_exchange_weak(now, to, std::memory_order_relaxed)) {
  }
}

}  // namespace

float landingTrust(const Landing& landing, double scale, const Vec3f& carriedNormal) {
  const double off = landing.point.distance / scale;
  const float agreement = std::clamp(2.0f * landing.normal.dot(carriedNormal), 0.0f, 1.0f);
  return float(std::exp(-off * off)) * agreement;
}

float stretchTrust(const TexelGradient& gradient, double spacing) {
  return std::clamp(kMuchStretch / texture::stretch(gradient, spacing), kLeastForStretch, 1.0f);
}

std::vector<float> neighborTrust(const texture::SurfaceMesh& mesh, const std::vector<Vec3f>& landed,
                                 const std::vector<Mat3d>& map, const std::vector<std::uint8_t>& stays) {
  std::vector<float> trust(mesh.positions.size(), 1.0f);
  texture::forEachIndex(mesh.triangles.size(), [&](std::uint32_t t) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      if (a > b || stays[a] != stays[b]) continue;  // the triangle on the other side has it
      const Vec3f edge = mesh.positions[b] - mesh.positions[a];
      const Vec3f expected((map[a] + map[b]) * Vec3d(edge) * 0.5);
      const float unit = std::max({float(mesh.spacing), edge.length(), expected.length()});
      const float jump = (landed[b] - landed[a] - expected).length() / unit;
      if (jump <= kUsualJump) continue;
      const float value = std::max(0.0f, (kLargeJump - jump) / (kLargeJump - kUsualJump));
      lower(trust[a], value);
      lower(trust[b], value);
    }
  });
  return trust;
}

}  // namespace fluidtex::transport
