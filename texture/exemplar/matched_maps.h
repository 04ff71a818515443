// Further maps matched beside colour: heights or roughness then continue across seams where colours alone
// leave a choice.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <map>
#include <string>

namespace fluidtex::texture {

struct MatchedMaps {
  Image image;         // of the exemplar's size; empty without matched maps
  double share = 1.0;  // share of the maps' variance that these channels hold
};

// Channels for the maps of weight > 0, sampled at the exemplar's texels as at vertices (maps.h). Each map is
// centred and scaled so that its variance is `weight` times that of the colours, whose standard deviation
// counts as 0.02 at least; it is 0 where the exemplar is transparent. All maps together are reduced to their
// principal components [Lefebvre06], at most `most`; constant maps contribute none.
// color: straight RGBA. encoded: colours as they are matched.
// Throws std::invalid_argument if a map with a weight holds vectors or no pixels, or `most` < 1.
MatchedMaps matchedMaps(const std::map<std::string, ExemplarMap>& maps, const Image& color,
                        const Image& encoded, bool toroidal, int most);

}  // namespace fluidtex::texture
