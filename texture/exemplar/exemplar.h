// The example image, prepared once: levels of detail, channels to match by, colours to look up.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/exemplar/kept.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <map>
#include <string>

namespace fluidtex::texture {

// Numbers or vectors over the same picture, ready to be looked up at vertices.
struct ExemplarMap {
  Image image;
  MapHolds holds = MapHolds::values;
  float weight = 0.0f;  // in matching, see MapOptions
};

struct Exemplar {
  bool toroidal = false;
  // Linear RGBA at full size, straight alpha; what the colour of a vertex is looked up in.
  Image color;
  // match[L]: what windows are compared and averaged by, reduced by 2^L: sRGB-encoded premultiplied R, G, B,
  // (A where the image has alpha that varies,) the guidance map, the maps that are matched, then the
  // feature-distance and gradient channels, each multiplied by the square root of its weight. A channel of
  // weight 0 is left out. Texel x of level L lies at 2^L x + (2^L - 1) / 2 of level 0.
  std::vector<Image> match;
  int colorChannels = 3;  // of match: 3 or 4, the first ones
  // The guidance map is the channel right after the colours, multiplied by the root of its weight.
  bool guided = false;
  float guidanceWeight = 1.0f;
  // Further maps over the same picture, ready to be looked up at vertices (texture/shown/maps.h), and how
  // many channels of `match` those of weight have become (texture/exemplar/matched_maps.h).
  std::map<std::string, ExemplarMap> maps;
  int mapChannels = 0;
  double mapShare = 1.0;  // MatchedMaps::share
};

// Reads an image (8- or 16-bit, float; grey, RGB, RGBA, CMYK turned into RGB) and prepares `levels` levels.
// Throws ExemplarError: missing, not an image, smaller than the largest window (which is shortened at any
// level whose image leaves it no choice of places, see fittingWindow), too small for any window, fully
// transparent, values that are not finite; a guidance map of another size.
// `match` is kept in `cache` from run to run, by all that it is made from.
Exemplar loadExemplar(const ExemplarOptions& options, const SynthesisOptions& synthesis, int levels,
                      const CacheFolder& cache = {});

// The same from pixels in memory (linear RGBA); guidance: one channel, 0..1, of the same size, or empty;
// maps: by name, of any size. Throws std::invalid_argument where the image is not RGBA, or a map of weight
// holds vectors.
Exemplar makeExemplar(Image color, bool toroidal, const SynthesisOptions& synthesis, int levels,
                      Image guidance = {}, const CacheFolder& cache = {},
                      std::map<std::string, ExemplarMap> maps = {});

}  // namespace fluidtex::texture
