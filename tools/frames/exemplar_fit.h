// How much of the exemplar a surface can show.
#pragma once

#include "texture/options.h"

#include <string>

namespace fluidtex::tools {

// One point shows one pixel. A sentence where a surface of this many points shows so little of an exemplar of
// width x height pixels that features of a usual one are not seen whole, and what would help; else empty.
std::string fitNote(const texture::Options& options, int width, int height, double points);

}  // namespace fluidtex::tools
