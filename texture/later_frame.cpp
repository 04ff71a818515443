#include "texture/later_frame.h"

#include "texture/renewal.h"

#include <algorithm>

namespace fluidtex::texture {
namespace {

// Around what is renewed, this many rings may change with it, so that seams find a place.
constexpr int kRim = 5;
// How near joined labels stay to the last average.
constexpr float kData = 0.4f;

}  // namespace

LaterFrame synthesizeLater(Synthesizer& synthesizer, const MeshView& view, const Carried& carried, int frame,
                           double secondsSinceLast, SynthesisStats& stats, const Progress& progress) {
  const SynthesisOptions& options = synthesizer.options;
  const TexelImage& image = synthesizer.tables->image.front();
  const SeamModel seams = seamModel(synthesizer, view, 0);
  const Labels before = labelsOf(view.mesh, carried.coordinate, carried.gradient);
  LaterFrame result{before, std::vector<std::uint8_t>(before.size(), 0)};

  const DiscOptions discOptions{options.keepStretch, options.renewalRadius,
                                options.renewalRate * secondsSinceLast};
  Level level{
      view, image, synthesizer.tables->histogram.front(), {}, lostLabels(seams, before, carried.trust)};
  for (const Disc& disc :
       worstDiscs(seams, before, carried.trust, carried.fading.weight, discOptions, options.seed))
    for (const std::uint32_t v : disc.members) level.wanted[v] = 1;
  if (std::find(level.wanted.begin(), level.wanted.end(), 1) == level.wanted.end()) return result;
  level.wanted = grown(view.graph, level.wanted, kRim);

  State state;
  state.labels = before;
  state.value = state.average = lookUp(image, before);
  level.constraint.value = state.value;
  level.constraint.weight = constraintWeights(view, state.value, carried.trust, options.softConstraint);
  runPasses(synthesizer, level, {0, frame, options.laterIterations, 1, false}, state, stats, progress);
  joinLabels(seams, state, kData, level.wanted, &before, keyOf(synthesizer, frame, 0, 1), state.labels);
  result.labels = settle(seams, before, state.labels, carried.trust, result.renewed);
  return result;
}

}  // namespace fluidtex::texture
