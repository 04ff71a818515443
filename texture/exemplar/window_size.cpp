#include "texture/exemplar/window_size.h"

#include <algorithm>

namespace fluidtex::texture {

int fittingWindow(const Image& match, bool toroidal, int window) {
  const int side = std::min(match.width, match.height);
  const int most = toroidal ? side : std::max(1, side * 5 / 8);
  return std::min(window, most % 2 == 1 ? most : most - 1);
}

}  // namespace fluidtex::texture
