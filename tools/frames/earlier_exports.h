// The frames that an earlier run has done, in the formats that the run which continues it is asked for.
#pragma once

#include "tools/frames/export_frame.h"

#include <atomic>

namespace fluidtex::tools {

// Of frames `first` to `last`: writes the files that the journal does not have whole; and all of a format
// that comes out otherwise now, as with joints of the other kind, so that a sequence is of one kind. Frame
// `last` tells, and is written last, so that what was interrupted is noticed again. Throws as exportFrame(),
// and Interrupted once `stop` is set.
void exportEarlierFrames(const std::filesystem::path& out, int first, int last, const Exports& exports,
                         const texture::Image& color, const std::atomic<bool>& stop);

}  // namespace fluidtex::tools
