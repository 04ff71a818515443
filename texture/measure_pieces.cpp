#include "texture/chips.h"
#include "texture/measure.h"
#include "texture/measure_gradient.h"
#include "texture/measure_tiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::texture {
namespace {

// Sets of vertices that are joined one by one.
class Joined {
 public:
  explicit Joined(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), 0u); }
  std::uint32_t rootOf(std::uint32_t v) {
    while (m_parent[v] != v) v = m_parent[v] = m_parent[m_parent[v]];
    return v;
  }
  void join(std::uint32_t a, std::uint32_t b) { m_parent[rootOf(a)] = rootOf(b); }

 private:
  std::vector<std::uint32_t> m_parent;
};

double squaredDifference(const float* a, const float* b) {
  double sum = 0.0;
  for (int c = 0; c < 3; ++c) sum += double(a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// Mean squared difference of texels side by side.
double neighborContrast(const Image& picture) {
  double sum = 0.0;
  for (int y = 0; y + 1 < picture.height; ++y)
    for (int x = 0; x + 1 < picture.width; ++x)
      sum += 0.5 * (squaredDifference(picture.at(x, y), picture.at(x + 1, y)) +
                    squaredDifference(picture.at(x, y), picture.at(x, y + 1)));
  return sum / (double(picture.width - 1) * (picture.height - 1));
}

}  // namespace

std::optional<Pieces> measurePieces(const TexturedSurface& surface, const Image& color, bool toroidal) {
  if (surface.empty()) return std::nullopt;
  const TileGround ground(surface);
  const Coordinates coordinates{surface, ground.graph, toroidal};
  const auto gradient = fittedGradients(coordinates);
  const std::size_t count = surface.positions.size();
  const bool allNew = std::none_of(surface.trust.begin(), surface.trust.end(),
                                   [](float trust) { return trust >= kNewSurface; });
  const auto counts = [&](std::uint32_t v) { return allNew || surface.trust[v] >= kNewSurface; };
  const std::vector<Vec3f> shown = seenColors(surface);

  Joined joined(count);
  std::vector<int> coherent(count, 0);
  double across = 0.0, lengths = 0.0;
  std::size_t edges = 0, joints = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    if (!counts(v)) continue;
    for (const std::uint32_t u : ground.graph.around(v)) {
      if (u < v || !counts(u)) continue;
      ++edges;
      if (cohere(coordinates, gradient, v, u)) {
        joined.join(v, u);
        ++coherent[v], ++coherent[u];
        continue;
      }
      ++joints;
      across += squaredDifference(shown[v].asPointer(), shown[u].asPointer());
      lengths += ((surface.positions[u] - surface.positions[v]) / float(surface.spacing)).lengthSqr();
    }
  }
  std::vector<int> sizes(count, 0);
  std::vector<float> distortions;
  std::size_t measured = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    if (!counts(v)) continue;
    ++measured;
    ++sizes[joined.rootOf(v)];
    if (coherent[v] >= 3) distortions.push_back(distortion(*gradient[v]));
  }
  if (measured == 0) return std::nullopt;
  Pieces result;
  std::size_t inChips = 0;
  for (const int size : sizes) {
    result.pieces += size > 0;
    if (size < int(kChip)) inChips += std::size_t(size);
  }
  result.chips = double(inChips) / double(measured);
  result.joints = edges > 0 ? double(joints) / double(edges) : 0.0;
  if (joints > 0)
    result.seams = std::sqrt(across / std::max(lengths * neighborContrast(seenPicture(color)), 1e-12));
  result.shape = percentile(distortions, 0.95);
  return result;
}

}  // namespace fluidtex::texture
