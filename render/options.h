// Settings of the picture: camera, light, materials, size.
#pragma once

#include <openvdb/math/Vec3.h>

#include <string>

namespace fluidtex::render {

using Vec3d = openvdb::math::Vec3<double>;

// The default frames a tank of 1 m.
struct Camera {
  Vec3d from{2.3, -1.6, 1.6};  // metres, at the first frame
  Vec3d at{0.5, 0.5, 0.4};     // looked at
  double fov = 30.0;           // vertical field of view, degrees
  // Degrees the camera turns over the whole animation, counter-clockwise seen from above, around the vertical
  // axis through `at`.
  double turn = 0.0;
  double aperture = 0.0;  // metres across the lens; 0: all is sharp
  double focus = 0.0;     // metres from the lens to what is sharp; 0: as far as `at`
  double shutter = 0.0;   // how much of a frame it is open, around the frame's moment; 0: nothing is blurred
};

// With these defaults a white matt surface that faces the sun under the open sky has radiance 1: at exposure
// 1 a texture's colours are those of its exemplar there.
struct Light {
  Vec3d sunDirection{-0.35, -0.6, 0.75};  // towards the sun
  Vec3d sunColor{1.95, 1.86, 1.7};        // linear irradiance on a plane that faces the sun
  double sunSize = 4.0;                   // degrees across; soft shadows
  Vec3d skyColor{0.37, 0.42, 0.5};        // zenith, linear
  Vec3d horizonColor{0.8, 0.8, 0.8};      // also seen below the horizon where there is no ground
};

struct Surroundings {
  bool ground = true;                   // a plane below the domain
  Vec3d groundColor{0.74, 0.73, 0.71};  // linear
  bool tank = true;                     // thin rods along the edges of the domain
  Vec3d tankColor{0.16, 0.16, 0.17};
};

// Relief from one of the texture's maps, see render/bump.h; ignored on a surface without that map.
struct Bump {
  std::string map;      // its name; empty: none
  double height = 1.0;  // values: spacings between 0 and 1; normals: factor on their slope; 0: no relief
  bool any() const { return !map.empty() && height != 0.0; }
};

// What the liquid is made of where its texture lets it be seen.
enum class MaterialKind {
  coated,  // the texture, matt, below a clear coat; where its alpha is below 1 it is cut out
  water,   // a clear liquid; the texture lies on it as far as its alpha says
  lava     // coated, and it glows
};

struct LiquidMaterial {
  MaterialKind kind = MaterialKind::coated;
  double index = 1.333;               // water: of refraction
  Vec3d absorption{1.2, 0.35, 0.25};  // water: 1/m, exp(-absorption x) of red, green, blue is left after x
  double cover = 1.0;                 // water: how far the texture hides it where its alpha is 1
  std::string heat;                   // lava: the map, 0..1, that says how hot it is; empty: all of it is
  double coldest = 800.0;             // lava: kelvin where that map is 0; it glows as a black body
  double hottest = 1450.0;            // lava: where it is 1
  double glow = 3.0;                  // lava: radiance of the hottest, as luminance
  bool glows() const { return kind == MaterialKind::lava && glow > 0.0; }
};

struct Options {
  int width = 960, height = 540;
  int samples = 32;  // paths per pixel at most; powers of two are distributed best
  // Standard error of what is displayed, 0..1, at which a part of the picture is done; 0: never.
  double noise = 0.01;
  bool smooth = true;       // takes the grain out of the light on matt surfaces
  int bounces = 2;          // of light between surfaces; 0: direct light only
  double gloss = 1.0;       // strength of the clear coat that makes liquid look wet, 0..1
  double roughness = 0.05;  // of the coat, GGX alpha
  LiquidMaterial material;
  Bump displacement;  // of values alone, see render/displace.h
  Bump bump;
  double exposure = 1.0;  // picture value = exposure * radiance, compressed above 0.8 to below 1
  Camera camera;
  Light light;
  Surroundings surroundings;
};

}  // namespace fluidtex::render
