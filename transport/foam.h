// Foam on a moving surface.
#pragma once

#include "sim/frame/frame.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <vector>

namespace fluidtex::transport {

// How much of the surface is foam at each position, 0..1, at the end of a frame. Water that is sheared,
// turned or squeezed fast takes air in: there is at least as much foam as the size of the velocity's gradient
// (1/s, the root of the sum of its squares) asks for, smoothly from options.from to options.full. What
// `carried` brings along fades by exp(-seconds / options.lifetime), where it is believed
// (texture/frames/renewal.h). In the first frame, and where no velocity is known, nothing is added. carried:
// one entry per position, or empty; else, or where the options make no sense, std::invalid_argument is
// thrown.
std::vector<float> foamAfter(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame,
                             const texture::Carried& carried, double seconds, const texture::Foam& options);

}  // namespace fluidtex::transport
