// A camera that may turn around the scene, with a thin lens.
#pragma once

#include "render/options.h"
#include "render/vec.h"

namespace fluidtex::render {

// The camera at one moment, ready to make rays.
struct CameraRays {
  Vec3f origin;
  Vec3f forward;                          // unit
  Vec3f right, down;                      // one pixel's step in the plane at distance 1
  Vec2f center;                           // pixel coordinates where `forward` hits
  float lensRadius = 0.0f, focus = 1.0f;  // metres; distance along `forward` of the plane that is sharp

  // Unit direction through pixel coordinates: (0,0) is the picture's top left corner, (width,height) the
  // bottom right.
  Vec3f direction(float x, float y) const;

  // The ray through pixel coordinates from a place on the lens, which is the unit disc.
  struct FromLens {
    Vec3f origin, direction;
  };
  FromLens fromLens(float x, float y, const Vec2f& place) const;
};

// `progress` in 0..1: how far the animation has come. Z is up; seen from straight above or below, up in the
// picture is +y. Throws std::invalid_argument if `from` and `at` coincide or the field of view is not within
// 0..180 degrees.
CameraRays makeCamera(const Camera& camera, int width, int height, double progress);

}  // namespace fluidtex::render
