// E-step: finds the best matching exemplar window for each neighbourhood.
#pragma once

#include "texture/labels/guidance.h"
#include "texture/labels/ways.h"
#include "texture/optimize/optimize.h"

#include <vector>

namespace fluidtex::texture {

// Windows of a pass: their neighbourhoods (#P, with #N entries in total) and matches.
struct Windows {
  Neighborhoods neighborhoods;
  PixelNeighborhoods pixels;  // empty where the pass searches no tree
  WindowLinks links;
  std::vector<float> falloff;   // #N: g
  std::vector<float> mass;      // #P: sum of g
  std::vector<Vec2f> match;     // #P: texel at the window's centre
  std::vector<Way> way;         // #P: symmetry variant of the match
  Ways ways;                    // of the exemplar
  std::vector<float> distance;  // #P: D_p / m_p
  Demand demand;

  // Texel that the match of neighbourhood p predicts at an offset, in pixels.
  Vec2f texelAt(std::size_t p, const Vec2f& offset) const { return match[p] + laid(way[p], offset); }
};

Windows makeWindows(const Level& level, const Pass& pass);

// Fills query.pixels and query.mask with neighbourhood p, turned into the symmetry variant `way`. Requires
// that makeWindows() was given a pass with a table and probes > 0.
void fillQuery(const Windows& windows, std::size_t p, const Values& value, WindowQuery& query, int channels,
               Way way = 0);

// Updates the distances of the present matches.
void measureMatches(const TexelImage& image, const Values& value, Windows& windows);

// Initial matches from the tree, where there are no labels to start from.
void findFirstMatches(const Level& level, const Pass& pass, const Values& value, Windows& windows);

// One E-step. Candidates of a window: propagation from neighbouring windows, k-coherence (windows similar to
// the best so far), the tree's best in every symmetry variant, and random ones. Takes the best of those that
// lower the window's distance; parts of the exemplar used more than the mean are penalised (`usage`).
void improveMatches(const Level& level, const Pass& pass, int iteration, double usage, const Values& value,
                    Windows& windows);

}  // namespace fluidtex::texture
