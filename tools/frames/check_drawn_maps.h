// Checks that the maps which a picture is drawn by can be.
#pragma once

#include "render/options.h"
#include "texture/exemplar/exemplar.h"

namespace fluidtex::tools {

// The number of a map's channels is known only from its picture. Throws texture::ExemplarError if the map of
// the relief, the displacement or the heat holds values of several channels.
void checkDrawnMaps(const render::Options& options, const texture::Exemplar& exemplar);

}  // namespace fluidtex::tools
