// Foam on a moving surface.
#pragma once

#include "sim/frame/frame.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <vector>

namespace fluidtex::transport {

// Foam, 0..1, at each position at the end of a frame. Water that is sheared, rotated or compressed fast
// entrains air: foam is at least smoothstep(options.from, options.full) of the Frobenius norm of the velocity
// gradient, 1/s. Transported foam decays by exp(-seconds / options.lifetime) and counts where its trust is
// sufficient (believed(), texture/frames/renewal.h). In the first frame, and where velocity is unknown, none
// is added.
// carried: one entry per position, or empty. Throws std::invalid_argument if it is neither, or unless
// lifetime > 0 and from < full.
std::vector<float> foamAfter(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame,
                             const texture::Carried& carried, double seconds, const texture::Foam& options);

}  // namespace fluidtex::transport
