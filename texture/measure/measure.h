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

// What one frame's exemplar coordinates show. Two neighbours cohere where each one's gradient, fitted to its
// neighbours, puts the other within 0.75 texels (mean of both) of where it is; pieces are what coheres.
// Surface that is new in its frame (trust below kNewSurface) is left out, unless all is.
struct Pieces {
  // 95th percentile of max(s1, 1 / s2), s the singular values of the fitted gradients (texels a texel), over
  // vertices that cohere with three neighbours or more; 1 is undistorted.
  double shape = 0.0;
  // rms difference of colour a texel across edges between pieces, over that between texels side by side in
  // the exemplar; 0 without such edges.
  double seams = 0.0;
  double joints = 0.0;  // share of the edges that lie between pieces
  double chips = 0.0;   // share of the vertices in pieces of fewer than 25
  int pieces = 0;
};

// What is new from one frame to the next. Vertices of new surface are left out.
struct Change {
  // 99.9th percentile of a vertex's change along the flow: mean over R, G, B of the difference from the last
  // frame's colour where the vertex was, read between its vertices.
  double pop = 0.0;
  // rms difference of luminance between what is shown and the last picture merely carried: the exemplar at
  // the carried coordinate (at the shown one where it is the same within half a texel), plus what the last
  // picture differed from the exemplar at its own, as in a fade. What resampling costs is not in it.
  double change = 0.0;
  double renewed = 0.0;  // share of the vertices whose coordinate is not the carried one
  double alongFlow =
      0.0;             // mean change along the flow, R, G and B, with the last frame read by a smooth kernel
  double ratio = 0.0;  // the same less what that reading costs, over shuffled vertices': 0 carried, 1 fresh
};

// What the flow alone asks for in a frame, whatever the texture: by what `renewed` and `change` can be
// judged.
struct FlowWear {
  // Share of the texture that the frame wears out, if none is to be squeezed or drawn out by more than 1.4:
  // mean over the vertices of min(1, e / (2 log 1.4)), e being the greater principal strain (logarithmic) of
  // the surface since the last frame.
  double worn = 0.0;
  // `change` if all that is worn gives way over its whole life, evenly, to texture that has nothing to do
  // with it: sqrt(2) times the deviation of the exemplar's luminance times the rms of the same share.
  double change = 0.0;
};

inline constexpr float kNewSurface = 0.5f;

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

// Squared gradient of an exemplar's luminance, as it is seen, averaged over 3 x 3 texels, over the mean of
// the whole: one channel. 1 everywhere where the exemplar is of one luminance. Edges are edges, whether it
// wraps or not. color: linear RGBA.
Image contrastOf(const Image& color);
// Mean of that over the texels that the vertices show, new surface's too, what fades in but not what fades
// out: 1 where all of the exemplar is shown alike, less where what has little contrast was chosen. Nothing
// without a surface.
std::optional<double> measureContrast(const TexturedSurface& surface, const Image& contrast);

// Nothing without a surface.
std::optional<Pieces> measurePieces(const TexturedSurface& surface, const Image& color, bool toroidal);

// after.previousPosition lies on `before`. Nothing where no vertex was there before.
std::optional<Change> measureChange(const TexturedSurface& before, const TexturedSurface& after,
                                    const Image& color, bool toroidal);

// Standard deviation of an exemplar's luminance, as it is seen. color: linear RGBA.
double deviationOfLuminance(const Image& color);

// Nothing where no vertex was there before. deviation: the exemplar's, as above.
std::optional<FlowWear> measureFlowWear(const TexturedSurface& surface, double deviation);

}  // namespace fluidtex::texture
