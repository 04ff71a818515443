#include "transport/foam.h"

#include "texture/frames/renewal.h"
#include "texture/loops/parallel.h"
#include "transport/carry.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fluidtex::transport {
namespace {

float smoothStep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

std::vector<float> foamAfter(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame,
                             const texture::Carried& carried, double seconds, const texture::Foam& options) {
  if (!carried.foam.empty() &&
      (carried.foam.size() != positions.size() || carried.trust.size() != positions.size()))
    throw std::invalid_argument("foam: what is carried must have one entry per position");
  if (!(options.lifetime > 0.0) || !(options.from < options.full))
    throw std::invalid_argument("foam: the lifetime must be positive, and full above from");
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
