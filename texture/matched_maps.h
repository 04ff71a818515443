// Further maps that windows are matched by, beside the colours: where colours leave a choice, heights or
// roughness go on from piece to piece.
#pragma once

#include "texture/exemplar.h"

#include <map>
#include <string>

namespace fluidtex::texture {

struct MatchedMaps {
  Image image;        // of the exemplar's size; without any map of weight, no channels and no pixels
  double kept = 1.0;  // share of the maps' differences (weighted variance) that these channels hold
};

// The maps whose weight is above 0, read at the exemplar's texels as they are at vertices (maps.h), each less
// its mean and multiplied so that its variance is `weight` times the colours'; 0 where the exemplar is
// transparent. More numbers than `most` are reduced to their first principal components, which keep the
// differences of texels as far as so few can [Lefebvre06]. `encoded` holds the exemplar's colours as they are
// matched. Throws std::invalid_argument if a map of weight holds vectors or `most` is below 1.
MatchedMaps matchedMaps(const std::map<std::string, ExemplarMap>& maps, const Image& color,
                        const Image& encoded, bool toroidal, int most);

}  // namespace fluidtex::texture
