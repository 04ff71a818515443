// Takes the grain out of the light on matt surfaces, and leaves their texture as it is.
#pragma once

#include "render/layers.h"

namespace fluidtex::render {

// All light of the picture with the matt light smoothed: it is divided by the albedo, so that the texture is
// no part of it, averaged over pixels that show the same smooth piece of surface and differ by no more than
// their noise, and multiplied by the albedo again. Where the standard error is 0 all around nothing changes.
// The mean is an edge-avoiding a-trous wavelet of five levels, 5 x 5 pixels each [Dammertz et al. 2010],
// weighted by normal, distance from the tangent plane and luminance against its error [Schied et al.,
// Spatiotemporal variance-guided filtering, 2017].
std::vector<Vec3f> smoothedRadiance(Layers layers);

}  // namespace fluidtex::render
