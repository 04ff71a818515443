// Comparison of patch sets, for likeness and coverage.
#pragma once

#include "texture/measure/tiles.h"

#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace fluidtex::texture {

// Pyramid of the pictures by halving, at most three levels: a picture is halved while its shorter side is at
// least 14 texels, twice the width of the smaller patches (7).
std::vector<Stack> pyramidOf(Stack stack);

// Keyed by pyramid level and width of the patches.
using PatchDistances = std::map<std::pair<int, int>, double>;

// Sliced Wasserstein distance of patch sets to those of a reference [Rabin, Peyre, Delon, Bernot 2011], along
// directions from the reference's principal components.
class PatchJudge {
 public:
  PatchJudge(const std::vector<Stack>& reference, int patches, Dice& dice);

  PatchDistances distances(const std::vector<Stack>& pyramid, Dice& dice) const;

 private:
  struct Space;
  int m_patches;
  std::map<std::pair<int, int>, std::shared_ptr<const Space>> m_spaces;
};

// Mean, over pyramid levels and patch widths, of the ratio of distance to self-distance. Self-distance: mean
// of `own`, the distances between halves of the exemplar, at that level and width, at least 0.02.
double patchRatio(const PatchDistances& distances, const std::vector<PatchDistances>& own);

// Which of an exemplar's 8 x 8 parts patches of nine texels resemble, at eight rotations.
class CoverageMap {
 public:
  // picture: as from encodedPicture().
  CoverageMap(const Image& picture, Dice& dice);

  // Effective number of parts among patches drawn from the pictures: exponential of the entropy.
  double effectiveParts(const Stack& stack, Dice& dice) const;

 private:
  struct Internals;
  std::shared_ptr<Internals> m_internals;
};

// Windows reduced to 20 principal components: #windows x dimension.
struct Reduced {
  int dimension = 0;
  std::vector<float> values;
};
Reduced reducedWindows(const std::vector<float>& windows, int dimension);

// Share of the windows that have another one with far(i, j) within a fifth of the rms length. Tested on about
// `asked` of them, evenly spread.
double shareWithTwin(const Reduced& windows, int asked,
                     const std::function<bool(std::size_t, std::size_t)>& far);

}  // namespace fluidtex::texture
