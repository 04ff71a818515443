// From a frame's labels to coordinates, cross-fade and colours.
#include "texture/frames/synthesize.h"

#include "texture/exemplar/srgb.h"
#include "texture/frames/first_frame.h"
#include "texture/frames/later_frame.h"
#include "texture/frames/renewal.h"
#include "texture/loops/parallel.h"
#include "texture/shown/maps.h"
#include "texture/shown/plain.h"
#include "texture/shown/shown_color.h"
#include "texture/vertex_arrays.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

Float8 encoded(const Vec4f& color, int channels) {
  Float8 value{};
  for (int c = 0; c < 3; ++c) value[c] = encodeSrgb(color[c] * color[3]);
  if (channels > 3) value[3] = color[3];
  return value;
}

Vec4f decoded(const Float8& value, int channels) {
  const float alpha = channels > 3 ? std::clamp(value[3], 0.0f, 1.0f) : 1.0f;
  Vec4f color(0.0f, 0.0f, 0.0f, alpha);
  for (int c = 0; c < 3; ++c) color[c] = alpha > 1e-4f ? std::max(0.0f, decodeSrgb(value[c])) / alpha : 0.0f;
  return color;
}

// [Kwatra07]: transported colours are averaged, under the soft constraint.
State synthesizeColors(Synthesizer& synthesizer, const MeshView& view, const Carried& carried, int frame,
                       SynthesisStats& stats, const Progress& progress) {
  State state;
  const int channels = synthesizer.exemplar.colorChannels;
  state.value.resize(carried.color.size());
  forEachIndex(state.value.size(),
               [&](std::uint32_t v) { state.value[v] = encoded(carried.color[v], channels); });
  Level level{view, synthesizer.tables->image.front(), synthesizer.tables->histogram.front(), {}, {}};
  level.constraint.value = state.value;
  level.constraint.weight =
      constraintWeights(view, state.value, carried.trust, synthesizer.options.softConstraint);
  runPasses(synthesizer, level, {0, frame, synthesizer.options.laterIterations}, state, stats, progress);
  return state;
}

void checkSizes(const SurfaceMesh& mesh, const Carried& carried) {
  const std::size_t count = mesh.positions.size();
  const auto right = [&](std::size_t size) { return size == count; };
  if (!right(mesh.normals.size()) || !right(mesh.orientation.size()))
    throw std::invalid_argument("synthesize: the surface must be oriented");
  if (!mesh.guidance.empty() && !right(mesh.guidance.size()))
    throw std::invalid_argument("synthesize: guidance must have one value per vertex");
  if (carried.empty()) return;
  forEachTextureArray(carried, [&](const auto& values, Array array) {
    if (!fits(values, array, count))
      throw std::invalid_argument("synthesize: carried arrays must have one entry per vertex");
  });
  if (!fits(carried.renewal, Array::optional, count))
    throw std::invalid_argument("synthesize: renewal must have one factor per vertex");
}

// Cross-fade after a frame. A vertex that is renewed fades from what it showed before. Where trust was low,
// the new texture shows at once.
Fading fadingAfter(const Carried& carried, const LaterFrame& later, double seconds) {
  const std::size_t count = later.labels.size();
  Fading result = carried.fading;
  forEachIndex(count, [&](std::uint32_t v) {
    if (later.renewed[v]) {
      result.weight[v] = believed(carried.trust[v]) ? 1.0f : 0.0f;
      result.speed[v] = later.fadingSpeed[v];
      // A vertex renewed within a cross-fade keeps the more visible of its two coordinates.
      if (carried.fading.weight[v] <= 0.5f) {
        result.coordinate[v] = carried.coordinate[v];
        result.gradient[v] = carried.gradient[v];
      }
    }
    // A fade speeds up with the flow: a vertex can only be renewed again after it.
    const float speed = std::max(result.speed[v], later.fadingSpeed[v]);
    result.weight[v] = std::max(0.0f, result.weight[v] - speed * float(seconds));
  });
  return result;
}

}  // namespace

TexturedSurface synthesize(Synthesizer& synthesizer, Surface surface, const Carried& carried, int frame,
                           double secondsSinceLast, SynthesisStats& stats, const Progress& progress) {
  stats = {};
  TexturedSurface result;
  result.exemplarWidth = synthesizer.exemplar.color.width;
  result.exemplarHeight = synthesizer.exemplar.color.height;
  if (surface.empty()) return result;
  SurfaceMesh& mesh = surface.levels.front();
  checkSizes(mesh, carried);
  const std::size_t count = mesh.positions.size();
  const bool labels = synthesizer.options.method == Method::coordinates;

  State state;
  std::vector<std::uint8_t> renewed(count, 1);
  if (carried.empty()) {
    state = synthesizeFromNothing(synthesizer, surface, 0, frame, stats, progress);
  } else {
    const PreparedMesh prepared(mesh);
    if (labels) {
      LaterFrame later = synthesizeLater(synthesizer, surface, prepared.view(), carried,
                                         {frame, secondsSinceLast}, stats, progress);
      result.fading = fadingAfter(carried, later, secondsSinceLast);
      state.labels = std::move(later.labels);
      renewed = std::move(later.renewed);
    } else {
      state = synthesizeColors(synthesizer, prepared.view(), carried, frame, stats, progress);
    }
  }
  stats.renewed = double(std::accumulate(renewed.begin(), renewed.end(), std::size_t(0))) / double(count);

  result.color.resize(count);
  result.coordinate.resize(count);
  result.gradient.resize(count);
  result.age.assign(count, 0.0f);
  if (result.fading.weight.empty()) result.fading = noFading(count);
  const TexelImage& image = synthesizer.tables->image.front();
  forEachIndex(count, [&](std::uint32_t v) {
    const Label& label = state.labels[v];
    const bool kept = !renewed[v];
    result.coordinate[v] = kept ? image.brought(carried.coordinate[v]) : label.texel;
    result.gradient[v] = kept ? carried.gradient[v]
                              : gradientOf(label, mesh.orientation[v], mesh.normals[v], mesh.spacingAt(v));
    if (kept) result.age[v] = carried.age[v] + float(secondsSinceLast);
    if (labels)
      result.color[v] =
          shownColor(synthesizer.exemplar.color, synthesizer.around, synthesizer.exemplar.toroidal,
                     result.coordinate[v], result.fading.coordinate[v], result.fading.weight[v]);
    else
      result.color[v] = decoded(state.value[v], synthesizer.exemplar.colorChannels);
  });
  if (progress) progress(1.0);
  result.trust = carried.empty() ? std::vector<float>(count, 0.0f) : carried.trust;
  result.previousPosition = carried.empty() ? mesh.positions : carried.previousPosition;
  result.original = carried.original;
  for (std::size_t v = 0; v < result.original.size(); ++v)
    result.original[v] = result.original[v] && !renewed[v];
  static_cast<SurfaceMesh&>(result) = std::move(mesh);
  for (const auto& [name, map] : synthesizer.exemplar.maps)
    lookUp(name, map, synthesizer.exemplar.toroidal, result);
  return result;
}

}  // namespace fluidtex::texture
