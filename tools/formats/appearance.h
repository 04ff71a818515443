// What a format with materials says of the surface: a picture of the exemplar under a clear coat.
#pragma once

#include <string>

namespace fluidtex::tools {

struct Appearance {
  std::string name = "surface";  // of the scene
  double frameRate = 24.0;       // frames a second
  std::string picture;           // in the folder of the run; empty: colours of vertices instead
  bool toroidal = false;         // the picture is repeated beyond 0..1
  bool seeThrough = false;       // some of its alpha is below 1
  double gloss = 1.0;            // strength of the coat, 0..1
  double roughness = 0.05;       // of the coat, GGX alpha
  bool moves = false;            // the picture is one frame's
};

}  // namespace fluidtex::tools
