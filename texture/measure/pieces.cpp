#include "texture/measure/pieces.h"

#include "texture/labels/chips.h"
#include "texture/labels/coordinate_gradient.h"
#include "texture/labels/pieces.h"
#include "texture/measure/tiles.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

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

  std::vector<std::uint8_t> counted(count, 0), joined(ground.graph.neighbor.size(), 0);
  std::vector<float> distortions;
  double across = 0.0, lengths = 0.0;
  std::size_t edges = 0, joints = 0, measured = 0;
  for (std::uint32_t v = 0; v < count; ++v) {
    if (!counts(v)) continue;
    counted[v] = 1;
    ++measured;
    int coherent = 0;
    for (std::uint32_t h = ground.graph.first[v]; h < ground.graph.first[v + 1]; ++h) {
      const std::uint32_t u = ground.graph.neighbor[h];
      if (!counts(u)) continue;
      joined[h] = cohere(coordinates, gradient, std::min(u, v), std::max(u, v));
      coherent += joined[h];
      if (u < v) continue;
      ++edges;
      if (joined[h]) continue;
      ++joints;
      across += squaredDifference(shown[v].asPointer(), shown[u].asPointer());
      lengths += ((surface.positions[u] - surface.positions[v]) / float(surface.spacing)).lengthSqr();
    }
    if (coherent >= 3) distortions.push_back(distortion(*gradient[v]));
  }
  if (measured == 0) return std::nullopt;
  Pieces result;
  std::size_t inChips = 0;
  const auto isJoined = [&](std::uint32_t, std::uint32_t h) { return joined[h] != 0; };
  forEachPiece(ground.graph, counted, isJoined, [&](const std::vector<std::uint32_t>& piece) {
    ++result.pieces;
    if (piece.size() < kChip) inChips += piece.size();
  });
  result.chips = double(inChips) / double(measured);
  result.joints = edges > 0 ? double(joints) / double(edges) : 0.0;
  if (joints > 0)
    result.seams = std::sqrt(across / std::max(lengths * neighborContrast(seenPicture(color)), 1e-12));
  result.shape = percentile(distortions, 0.95);
  result.shapeMedian = percentile(distortions, 0.5);
  result.shapeWorst = percentile(distortions, 0.99);
  return result;
}

}  // namespace fluidtex::texture
