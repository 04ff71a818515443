#include "texture/joints/former.h"

#include "texture/loops/parallel.h"

#include <limits>

namespace fluidtex::texture {

Former formerPlaces(const TexturedSurface& surface) {
  Former result{{surface.coordinate, surface.gradient}, std::vector<std::uint8_t>(surface.positions.size())};
  const Fading& fading = surface.fading;
  if (fading.weight.empty()) return result;
  // The vertex that each one's former coordinate comes from.
  std::vector<std::uint32_t> source(surface.positions.size(), kNone);
  for (const Vec3I& corner : surface.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = corner[k];
      if (fading.weight[v] > 0.0f) {
        source[v] = v;
        continue;
      }
      for (const std::uint32_t u : {corner[(k + 1) % 3], corner[(k + 2) % 3]}) {
        if (!(fading.weight[u] > 0.0f)) continue;
        const std::uint32_t best = source[v];
        if (best == kNone || fading.weight[u] > fading.weight[best] ||
            (fading.weight[u] == fading.weight[best] && u < best))
          source[v] = u;
      }
    }
  }
  forEachIndex(source.size(), [&](std::uint32_t v) {
    const std::uint32_t u = source[v];
    if (u == kNone) return;
    result.known[v] = 1;
    result.places.coordinate[v] =
        continued(fading.coordinate[u], fading.gradient[u], surface.positions[v] - surface.positions[u]);
    result.places.gradient[v] = fading.gradient[u];
  });
  return result;
}

}  // namespace fluidtex::texture
