// The exemplar, prepared once: its pyramid, the channels matched, the colours looked up.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/exemplar/kept.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <map>
#include <string>

namespace fluidtex::texture {

// A further map over the exemplar, scalar or vector.
struct ExemplarMap {
  Image image;
  MapHolds holds = MapHolds::values;
  float weight = 0.0f;  // in matching, see MapOptions
};

struct Exemplar {
  bool toroidal = false;
  // Linear RGBA at full size, straight alpha; colours are looked up here.
  Image color;
  // Pyramid of what windows are compared and averaged by; level L is reduced by 2^L. Channels: sRGB-encoded
  // premultiplied R, G, B, (A where alpha varies,) the guidance map, matched maps, feature distance and
  // gradient energy, each times the square root of its weight. Channels of weight 0 are left out. Texel x of
  // level L lies at 2^L x + (2^L - 1) / 2 of level 0.
  std::vector<Image> match;
  int colorChannels = 3;  // of match: 3 or 4, the first ones
  // Whether the channel after the colours is the guidance map, times the root of its weight.
  bool guided = false;
  float guidanceWeight = 1.0f;
  // Further maps by name, looked up at the vertices (texture/shown/maps.h), and the number of channels of
  // `match` that those with a weight became (texture/exemplar/matched_maps.h).
  std::map<std::string, ExemplarMap> maps;
  int mapChannels = 0;
  double mapShare = 1.0;  // MatchedMaps::share
};

// Reads an image (8- or 16-bit, float; grey, RGB, RGBA, CMYK converted to RGB) and builds `levels` pyramid
// levels. `match` is cached in `cache`, keyed by all that it depends on. Of a sequence `color` is the first
// picture, and the others are matched beside it, so that joints hold over all of them: sixteen at most,
// spread evenly, reduced to principal components as maps are (texture/exemplar/matched_maps.h), which
// together count twice as much as the first. Throws ExemplarError: missing; not an image; smaller than the
// largest window, which is shortened at levels that leave no choice of places (fittingWindow); too small for
// any window; fully transparent; values that are not finite; a guidance map or a picture of a sequence of
// another size. guidance: one channel, 0..1, of the size of exemplarPicture(), where the options name no map.
Exemplar loadExemplar(const ExemplarOptions& options, const SynthesisOptions& synthesis, int levels,
                      const CacheFolder& cache = {}, Image guidance = {});

// The same from pixels in memory. color: linear RGBA. guidance: one channel, 0..1, of the same size, or
// empty. maps: by name, of any size. Throws std::invalid_argument if the image is not RGBA, or a map with a
// weight holds vectors.
Exemplar makeExemplar(Image color, bool toroidal, const SynthesisOptions& synthesis, int levels,
                      Image guidance = {}, const CacheFolder& cache = {},
                      std::map<std::string, ExemplarMap> maps = {});

// The picture of an exemplar as it is matched and looked up, and how long a side of it is, pixels, for a side
// of the file's.
Image exemplarPicture(const ExemplarOptions& options);
inline int exemplarSide(const ExemplarOptions& options, int pixels) {
  for (int n = 0; n < options.halvings; ++n) pixels = (pixels + 1) / 2;
  return pixels;
}

}  // namespace fluidtex::texture
