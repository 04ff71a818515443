// Which surface counts as new in the measures.
#pragma once

namespace fluidtex::texture {

// Trust below which a vertex is new surface. Stricter than in synthesis (texture/labels/fresh.h): values of
// middling trust may be kept or renewed, and say nothing about quality.
inline constexpr float kNewSurface = 0.5f;

}  // namespace fluidtex::texture
