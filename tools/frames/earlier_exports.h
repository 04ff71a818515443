// The frames that an earlier run has done, in the formats that the run which continues it is asked for.
#pragma once

#include "tools/frames/export_frame.h"

#include <atomic>

namespace fluidtex::tools {

// Completes the exports of frames `first` to `last`, which an earlier run has finished. Writes files that are
// missing or not as the journal records them. If a format's file of frame `last` would now have other bytes,
// for example with another setting of joints, that format is written again for all frames. Frame `last` is
// written last, so that an interrupted conversion is detected the next time. No effect if PLY is the only
// format. Throws as exportFrame(), and Interrupted once `stop` is set.
void exportEarlierFrames(const std::filesystem::path& out, int first, int last, const Exports& exports,
                         const texture::Image& color, const std::atomic<bool>& stop);

}  // namespace fluidtex::tools
