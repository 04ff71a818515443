// From radiance to what a screen shows.
#pragma once

namespace fluidtex::render {

// Multiplies linear radiance by `exposure` and compresses what is then above 0.8 exponentially to at most 1,
// so that colours up to there are true and highlights do not burn out. What is no number becomes 0.
float developed(float radiance, double exposure);

// The same, sRGB-encoded: 0..1, as a picture's file has it.
float displayed(float radiance, double exposure);

}  // namespace fluidtex::render
