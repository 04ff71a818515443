#include "transport/foam.h"

#include "texture/parallel.h"
#include "texture/renewal.h"
#include "transport/carry.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::transport {
namespace {

float smoothStep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

std::vector<float> foamAfter(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame,
                             const texture::Carried& carried, double seconds, const texture::Foam& options) {
  const auto slope = velocitySlopes(positions, frame);
  const auto kept = float(std::exp(-seconds / options.lifetime));
  std::vector<float> foam(positions.size());
  texture::forEachIndex(positions.size(), [&](std::uint32_t v) {
    float size = 0.0f;
    for (const std::vector<texture::Vec3f>& along : slope) size += along[v].lengthSqr();
    foam[v] = smoothStep(float(options.from), float(options.full), std::sqrt(size));
    if (!carried.foam.empty() && texture::believed(carried.trust[v]))
      foam[v] = std::max(foam[v], kept * carried.foam[v]);
  });
  return foam;
}

}  // namespace fluidtex::transport
