// Pictures of a textured surface without light: its colours alone, drawn in several ways.
#pragma once

#include "render/camera.h"
#include "tools/joints/ways.h"

#include <cstdint>
#include <vector>

namespace fluidtex::joints {

// What the points of a pixel lie in. mixed: in joints and elsewhere, or beside the surface.
enum class Kind : std::uint8_t { nothing, joint, elsewhere, mixed };

struct PictureSize {
  int width = 0, height = 0;  // pixels
};

// Pixels, rows from the top.
struct Seen {
  int width = 0, height = 0;
  std::vector<Kind> kind;
  std::vector<texture::Vec3f> position;       // mean of the pixel's points on the surface, metres
  std::vector<std::vector<float>> lightness;  // of each way: sRGB curve of the mean luminance, 0..1
};

// Looks at the surface through the camera at 4 x 4 points of each pixel; what hides behind others is not
// seen. cut: cutAtJoints() of the surface. Triangles count as joints if their corners are of different
// pieces, of what is shown or of what fades. The result does not depend on the number of threads.
Seen look(const texture::TexturedSurface& surface, const texture::Joints& joints,
          const texture::CutSurface& cut, bool toroidal, const std::vector<Way>& ways,
          const render::CameraRays& camera, const PictureSize& size);

// Whether the corners of a joint triangle are of different pieces; else it lies across the edge of a toroidal
// exemplar.
bool isOfSeveralPieces(const texture::Joint& joint, const texture::Torus& torus);

}  // namespace fluidtex::joints
