// The E-step: the exemplar window that each neighbourhood is matched with.
#pragma once

#include "texture/labels/guidance.h"
#include "texture/labels/ways.h"
#include "texture/optimize/optimize.h"

#include <vector>

namespace fluidtex::texture {

// Windows of a pass with their neighbourhoods and what they are matched with.
struct Windows {
  Neighborhoods neighborhoods;
  PixelNeighborhoods pixels;  // empty without a tree
  WindowLinks links;
  std::vector<float> falloff;   // #N: g
  std::vector<float> mass;      // #P: sum of g
  std::vector<Vec2f> match;     // #P: texel at the centre
  std::vector<Way> way;         // #P: how the exemplar lies there
  Ways ways;                    // the exemplar's
  std::vector<float> distance;  // #P: D_p / m_p
  Demand demand;

  // What the match of neighbourhood p puts at an offset (pixels).
  Vec2f texelAt(std::size_t p, const Vec2f& offset) const { return match[p] + laid(way[p], offset); }
};

Windows makeWindows(const Level& level, const Pass& pass);

// Fills query.pixels and query.mask with neighbourhood p as the exemplar has it that lies like that;
// makeWindows() must have had a pass with a tree.
void fillQuery(const Windows& windows, std::size_t p, const Values& value, WindowQuery& query, int channels,
               Way way = 0);

// Distances of the present matches.
void measureMatches(const TexelImage& image, const Values& value, Windows& windows);

// The first matches, where there are none to start from: the tree's best.
void findFirstMatches(const Level& level, const Pass& pass, const Values& value, Windows& windows);

// Offers every window the matches of its neighbours, shifted; windows alike to these; the tree's, turned in
// all ways; and random ones. Takes the best that is nearer than the present one; parts of the exemplar used
// more than the mean count as farther (`usage`).
void improveMatches(const Level& level, const Pass& pass, int iteration, double usage, const Values& value,
                    Windows& windows);

}  // namespace fluidtex::texture
