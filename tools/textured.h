// One frame's texture, by the way that the scene asks for.
#pragma once

#include "scenes/scene.h"
#include "texture/frames/synthesize.h"

namespace fluidtex::tools {

// The surface comes with its orientation. Of the result, velocity, contact and maps are left to fill. stats
// are those of synthesize(); without synthesis nothing is renewed.
texture::TexturedSurface textured(const scenes::Scene& scene, texture::Synthesizer& synthesizer,
                                  texture::Surface surface, const texture::Carried& carried, int frame,
                                  texture::SynthesisStats& stats,
                                  const std::function<void(double)>& progress);

// Whether a frame needs the coarser levels of the surface, too: the first one, or all where each stands
// alone.
bool needsAllLevels(const scenes::Scene& scene, const texture::TexturedSurface& last);

}  // namespace fluidtex::tools
