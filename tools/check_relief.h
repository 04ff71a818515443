// Whether the map that relief is to be drawn from can give any.
#pragma once

#include "render/options.h"
#include "texture/exemplar/exemplar.h"

namespace fluidtex::tools {

// Only the pictures themselves tell how many channels maps have. Throws texture::ExemplarError where the
// relief's map holds values of several.
void checkRelief(const render::Bump& bump, const texture::Exemplar& exemplar);

}  // namespace fluidtex::tools
