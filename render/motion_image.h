// What the camera sees of a textured liquid, unlit, and where each pixel of it was a frame ago: motion
// vectors.
#pragma once

#include "render/options.h"
#include "render/vec.h"
#include "texture/surface.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace fluidtex::render {

// height x width each, rows from the top.
struct MotionImage {
  int width = 0, height = 0;
  std::vector<Vec3f> color;     // of the vertices, interpolated; mid grey where no liquid is seen
  std::vector<float> distance;  // metres from the camera; infinite where no liquid is seen
  // Pixel coordinates of the place a frame ago, as the camera stood then: (0.5, 0.5) is the middle of the top
  // left pixel. NaN where no liquid is seen, where the place was behind the camera, and on new surface.
  std::vector<Vec2f> before;
  std::vector<float> distanceBefore;  // metres from the camera then
};

// A ray through the middle of each pixel. Solids hide nothing. color: #V, as seen without light, 0..1,
// sRGB-encoded. now, before: positions of a turning camera, 0 at the first and 1 at the last frame.
// leastTrust: below it surface is new.
MotionImage motionImage(const texture::TexturedSurface& surface, const std::vector<Vec3f>& color,
                        const Options& options, double now, double before, float leastTrust);

// Warp error [Lai et al., "Learning blind video temporal consistency", 2018, eq. (13)]: mean over pixels of
// the squared difference from the last picture, R, G and B summed, read (bilinear) where the pixel was.
struct WarpError {
  double error = 0.0;
  double share = 0.0;  // of the pixels with liquid: those that were seen a frame ago
};

// tolerance: metres, by which distances may differ where the same place is seen. Nothing if no pixel was seen
// a frame ago. Throws std::invalid_argument if the sizes differ.
std::optional<WarpError> warpError(const MotionImage& before, const MotionImage& now, double tolerance);

// Writes the motion from this frame to the one before, pixels, as Middlebury's FLO: "PIEH", width and height,
// then right and down of each pixel as floats; 1e10 where it is unknown. Throws std::runtime_error that names
// the file.
void writeFlo(const MotionImage& image, const std::filesystem::path& file);

}  // namespace fluidtex::render
