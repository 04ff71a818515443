// How good the texture of a run is, in figures. Colours are sRGB-encoded and lie in 0..1, what is see-through
// is seen before mid grey; lengths are in texels: one is the surface's spacing. Ratios to the exemplar are
// taken to the exemplar laid on the same vertices and read back the same way, so that they do not depend on
// the mesh.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/surface.h"

#include <cstdint>
#include <memory>
#include <optional>

namespace fluidtex::texture {

struct MeasureOptions {
  int tile = 47;    // texels across of the flat tiles that likeness is judged by; shorter where none are flat
  int tiles = 160;  // how many
  int patches = 2500;  // drawn from them
  std::uint64_t seed = 1;
};

// What one frame shows, on square tiles of the surface that are laid flat, in CIELAB / 100 (and alpha).
struct Likeness {
  // Sliced Wasserstein distance of the tiles' patches (7 and 15 texels wide, at every level of a pyramid that
  // holds them) to the exemplar's, over that of the exemplar's halves to each other: 1 is as like as the
  // exemplar is to itself, less is liker. Slices run along the exemplar's principal components, half
  // whitened, and along random mixtures of three; mean over widths and levels.
  double likeness = 0.0;
  // Mean squared gradient of the lightness over the exemplar's: 1 is right, less is blurred, more is noise.
  double sharpness = 0.0;
  // How much of the exemplar is in use: effective number (exponential of the entropy) of the 8 x 8 parts of
  // the exemplar that patches of 9 texels are nearest to, over the same of the exemplar itself.
  double coverage = 0.0;
  // Share of windows of 9 texels, read along the orientation, with a near-duplicate (within a fifth of the
  // usual contrast) more than 18 texels away on the surface, less the same share of the exemplar.
  std::optional<double> repeats;
  int tile = 0, tiles = 0;  // size and number of the tiles
};

// Judges frames against one exemplar. What it says of a frame does not depend on which frames it has judged
// before.
class LikenessJudge {
 public:
  // color: linear RGBA.
  explicit LikenessJudge(const Image& color, const MeasureOptions& options = {});
  ~LikenessJudge();

  // Nothing where fewer than four tiles of the surface are flat. `repeats`: that too, which takes as long
  // again as all else.
  std::optional<Likeness> operator()(const TexturedSurface& surface, bool repeats = false) const;

 private:
  struct Internals;
  std::unique_ptr<Internals> m_internals;
};

}  // namespace fluidtex::texture
