#include "texture/measure/wear.h"

#include "texture/frames/look_ahead.h"
#include "texture/measure/new_surface.h"
#include "texture/measure/tiles.h"
#include "texture/optimize/passes.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Stretch and compression that texture may have.
constexpr double kShape = 1.4;

}  // namespace

double deviationOfLuminance(const Image& color) {
  const Image picture = seenLuminance(color);
  double sum = 0.0, squares = 0.0;
  for (const float value : picture.data) sum += double(value), squares += double(value) * double(value);
  const auto count = double(picture.data.size());
  return std::sqrt(std::max(0.0, squares / count - sum / count * sum / count));
}

std::optional<FlowWear> measureFlowWear(const TexturedSurface& surface, double deviation) {
  const SurfaceMesh& mesh = surface;
  const PreparedMesh prepared(mesh);
  const std::vector<Strain> strain =
      strainRates(prepared.view(), surface.previousPosition, surface.trust, 1.0);
  double sum = 0.0, squares = 0.0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < strain.size(); ++v) {
    if (surface.trust[v] < kNewSurface) continue;
    const double worn = std::min(1.0, double(largest(strain[v])) / (2.0 * std::log(kShape)));
    sum += worn, squares += worn * worn;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return FlowWear{sum / double(count), std::sqrt(2.0 * squares / double(count)) * deviation};
}

}  // namespace fluidtex::texture
