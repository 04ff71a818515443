// Quality measures of a run's texture. Colours are sRGB-encoded, 0..1; transparent ones are composited over
// mid grey. Lengths are in texels, one per spacing of the surface. Ratios to the exemplar are taken to the
// exemplar laid on the same vertices and read back the same way, so that they do not depend on the mesh.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/surface.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace fluidtex::texture {

struct MeasureOptions {
  int tile = 47;       // side of the flattened tiles, texels; smaller if fewer than 24 (or `tiles`) are flat
  int tiles = 160;     // number of tiles
  int patches = 2500;  // number of patches drawn from them
  std::uint64_t seed = 1;
};

// Measures of one frame, on square flattened tiles of the surface, in CIELAB / 100 (and alpha).
struct Likeness {
  // Sliced Wasserstein distance of the tiles' patches (7 and 15 texels wide, at every pyramid level that they
  // fit) to the exemplar's, over the distance between halves of the exemplar: 1 is as close as the exemplar
  // to itself, less is closer. Slices are the exemplar's principal components, half whitened, and random
  // mixtures of three; mean over widths and levels.
  double likeness = 0.0;
  // Mean squared gradient of the lightness over the exemplar's: 1 is right, below is blur, above is noise.
  double sharpness = 0.0;
  // Distance of the lightness's radial power spectrum from the exemplar's, dB (spectrum.h): 0 is right. Blur
  // and noise show at high frequencies, features of another size at low ones.
  double spectrum = 0.0;
  // Share of the exemplar in use: effective number (exponential of the entropy) of its 8 x 8 parts that
  // patches of 9 texels are nearest to, over the same number for the exemplar itself.
  double coverage = 0.0;
  // Share of windows of 9 texels, read along the orientation, with a near-duplicate (within a fifth of the
  // usual contrast) more than 18 texels away on the surface, minus the same share for the exemplar.
  std::optional<double> repeats;
  int tile = 0, tiles = 0;  // size and number of the tiles
};

// Judges frames against one exemplar. The measures of a frame do not depend on frames judged before.
class LikenessJudge {
 public:
  // color: linear RGBA.
  explicit LikenessJudge(const Image& color, const MeasureOptions& options = {});
  ~LikenessJudge();

  // Nothing if fewer than four tiles of the surface are flat. repeats: measures that too, which doubles the
  // time.
  std::optional<Likeness> operator()(const TexturedSurface& surface, bool repeats = false) const;

 private:
  struct Internals;
  std::unique_ptr<Internals> m_internals;
};

}  // namespace fluidtex::texture
