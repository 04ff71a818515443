// Further maps that windows are matched by, beside the colours: where colours leave a choice, heights or
// roughness go on from piece to piece.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <map>
#include <string>

namespace fluidtex::texture {

struct MatchedMaps {
  Image image;         // of the exemplar's size; no channels and no pixels where nothing is matched
  double share = 1.0;  // of the maps' differences (variance) that these channels hold
};

// The maps whose weight is above 0, read at the exemplar's texels as they are at vertices (maps.h): each less
// its mean, multiplied so that its variance is `weight` times that of the colours, or of colours that deviate
// by 0.02 where they differ less; 0 where the exemplar is transparent. All together are turned to their
// principal components [Lefebvre06], of which there are as many as say anything, and at most `most`. A map
// that is the same everywhere says nothing. color: straight RGBA; encoded: the colours as they are matched.
// Throws std::invalid_argument if a map of weight holds vectors or no pixels, or `most` is below 1.
MatchedMaps matchedMaps(const std::map<std::string, ExemplarMap>& maps, const Image& color,
                        const Image& encoded, bool toroidal, int most);

}  // namespace fluidtex::texture
