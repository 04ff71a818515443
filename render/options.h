// Settings of the picture: camera, light, materials, size.
#pragma once

#include <openvdb/math/Vec3.h>

namespace fluidtex::render {

using Vec3d = openvdb::math::Vec3<double>;

struct Camera {
  Vec3d from{2.3, -1.75, 1.5};  // metres, at the first frame
  Vec3d at{0.5, 0.5, 0.35};               // looked at
  double fov = 35.0;           // vertical field of view, degrees
  double turn =
      0.0;  // degrees the camera turns around the vertical axis through `at`, over the whole animation
};

struct Light {
  Vec3d sunDirection{-0.5, -0.4, 0.8};  // towards the sun
  Vec3d sunColor{3.0, 2.85, 2.6};       // linear radiance times solid angle
  double sunSize = 3.0;                 // degrees across; soft shadows
  Vec3d skyColor{0.55, 0.65, 0.85};     // zenith, linear
  Vec3d horizonColor{0.95, 0.95, 0.95};
};

struct Surroundings {
  bool ground = true;  // a plane below the domain
  Vec3d groundColor{0.45, 0.45, 0.45};
  bool tank = true;  // thin rim along the edges of the domain
  Vec3d tankColor{0.25, 0.27, 0.3};
};

struct Options {
  int width = 960, height = 540;
  int samples = 16;         // paths a pixel
  int bounces = 2;          // diffuse
  double gloss = 1.0;       // strength of the clear coat that makes liquid look wet, 0..1
  double roughness = 0.05;  // of the coat
  double exposure = 1.0;    // picture value = exposure * radiance
  Camera camera;
  Light light;
  Surroundings surroundings;
};

}  // namespace fluidtex::render
