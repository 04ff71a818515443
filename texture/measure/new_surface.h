// Which surface counts as new when a texture is judged.
#pragma once

namespace fluidtex::texture {

// Trust below which a vertex counts as new in its frame. It is stricter than what synthesis believes
// (texture/labels/fresh.h): what is half believed is renewed or kept, but says nothing about how well.
inline constexpr float kNewSurface = 0.5f;

}  // namespace fluidtex::texture
