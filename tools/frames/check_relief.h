// Checks that the relief's map can be drawn as relief.
#pragma once

#include "render/options.h"
#include "texture/exemplar/exemplar.h"

namespace fluidtex::tools {

// The number of a map's channels is known only from its picture. Throws texture::ExemplarError if the
// relief's map holds values of several channels.
void checkRelief(const render::Bump& bump, const texture::Exemplar& exemplar);

}  // namespace fluidtex::tools
