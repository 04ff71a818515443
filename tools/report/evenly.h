// Choice of a few frames out of many.
#pragma once

#include <cstddef>
#include <vector>

namespace fluidtex::tools {

// `most` of the frames, evenly spread, the first and the last among them; all, where there are no more; of
// one, the middle one.
inline std::vector<int> evenly(const std::vector<int>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  if (most == 1) return {frames[frames.size() / 2]};
  std::vector<int> chosen;
  for (std::size_t n = 0; n < most; ++n)
    chosen.push_back(frames[(n * (frames.size() - 1) + (most - 1) / 2) / (most - 1)]);
  return chosen;
}

}  // namespace fluidtex::tools
