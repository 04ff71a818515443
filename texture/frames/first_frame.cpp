#include "texture/frames/first_frame.h"

#include "texture/labels/slips.h"

#include <algorithm>

namespace fluidtex::texture {
namespace {

// Side of the initial blocks, texels of the full exemplar.
constexpr float kBlockSize = 64.0f;
// Coarser levels decide the layout and are cheap: they iterate longer.
constexpr int kCoarseIterations = 3;
// Weight of the data term: difference of the labels' colours from the last average.
constexpr float kFirstData = 0.15f;

}  // namespace

State synthesizeFromNothing(Synthesizer& synthesizer, const Surface& surface, int finest, int frame,
                            SynthesisStats& stats, const Progress& progress) {
  const SearchTables& tables = *synthesizer.tables;
  int coarsest = int(std::min(surface.levels.size(), tables.image.size())) - 1;
  while (coarsest > 0 && surface.levels[std::size_t(coarsest)].positions.empty()) --coarsest;

  State state;
  double done = 0.0, whole = 0.0;
  for (int l = finest; l <= coarsest; ++l) whole += double(surface.levels[std::size_t(l)].positions.size());
  for (int l = coarsest; l >= finest; --l) {
    const std::size_t index = std::size_t(l);
    const SurfaceMesh& mesh = surface.levels[index];
    const PreparedMesh prepared(mesh);
    const TexelImage& image = tables.image[index];
    const Level level{prepared.view(),
                      image,
                      tables.histogram[index],
                      {},
                      l == 0 ? searched(synthesizer, prepared.graph) : std::vector<std::uint8_t>{}};
    if (l == coarsest)
      state.labels =
          blockLabels(level.view, image, kBlockSize / float(1 << l), keyOf(synthesizer, frame, l, 0));
    else
      state.labels = refineLabels(surface.levels[index + 1], state.labels, mesh, image);
    state.value = state.average = lookUp(image, state.labels);
    const double share = double(mesh.positions.size()) / whole;
    runPasses(synthesizer, level,
              {l, frame, synthesizer.options.firstIterations, l > 0 ? kCoarseIterations : 1}, state, stats,
              [&](double part) {
                if (progress) progress(done + share * part);
              });
    done += share;
    if (synthesizer.options.method == Method::coordinates) {
      const SeamModel seams = seamModel(synthesizer, level.view, index);
      joinLabels(seams, state, kFirstData, level.wanted, nullptr, keyOf(synthesizer, frame, l, 1),
                 state.labels);
      closeSlips(seams, level.wanted, state.labels);
    }
  }
  return state;
}

}  // namespace fluidtex::texture
