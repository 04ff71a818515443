// Sets of patches compared: the distance that likeness stands on, and what of the exemplar patches look like.
#pragma once

#include "texture/measure/tiles.h"

#include <functional>
#include <map>
#include <memory>
#include <utility>

namespace fluidtex::texture {

// The picture, and halves of it, halves of those, ... as long as the larger patches fit twice; at most three.
std::vector<Stack> pyramidOf(Stack stack);

// By level of the pyramid and width of the patches.
using PatchDistances = std::map<std::pair<int, int>, double>;

// The sliced Wasserstein distance of sets of patches to those of a reference [Rabin, Peyre, Delon, Bernot
// 2011], on directions from the reference's own principal components.
class PatchJudge {
 public:
  PatchJudge(const std::vector<Stack>& reference, int patches, Dice& dice);

  PatchDistances distances(const std::vector<Stack>& pyramid, Dice& dice) const;

 private:
  struct Space;
  int m_patches;
  std::map<std::pair<int, int>, std::shared_ptr<const Space>> m_spaces;
};

// Mean over levels and widths of distances over the mean of `own`, those that the exemplar has to itself.
double patchRatio(const PatchDistances& distances, const std::vector<PatchDistances>& own);

// Which of 8 x 8 parts of an exemplar patches of nine texels look like, at eight turns of it.
class CoverageMap {
 public:
  // picture: as of encodedPicture().
  CoverageMap(const Image& picture, Dice& dice);

  // Effective number of parts: the exponential of the entropy of patches drawn from the pictures.
  double effectiveParts(const Stack& stack, Dice& dice) const;

 private:
  struct Internals;
  std::shared_ptr<Internals> m_internals;
};

// Windows (#windows x dimension) in their first 20 principal components.
struct Reduced {
  int dimension = 0;
  std::vector<float> values;
};
Reduced reducedWindows(const std::vector<float>& windows, int dimension);

// Share of the windows that have another, for which far(i, j), within a fifth of the root mean square length.
// About `asked` of them, evenly spread, are asked.
double shareWithTwin(const Reduced& windows, int asked,
                     const std::function<bool(std::size_t, std::size_t)>& far);

}  // namespace fluidtex::texture
