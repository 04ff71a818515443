// Which layer of a picture of many is its colours.
#pragma once

#include "foreign/unreadable.h"

#include <string>
#include <vector>

namespace fluidtex::foreign {

struct Part {
  std::string name;                   // may be empty
  std::vector<std::string> channels;  // "R", "beauty.R", "ViewLayer.Combined.R", "Z", ...
};

struct Layer {
  int part = 0;
  std::vector<int> channels;  // of the part: grey; grey, alpha; red, green, blue; or with alpha
};

// By name, never by order: R, G and B without a layer's name, or a layer or part called RGBA, RGB, beauty,
// Combined or the like, or the only one that has colours; else a grey channel Y. `asNumbers`: normals X, Y, Z
// and a lone channel of any name too, depth included. Throws Unreadable with the layers' names where none of
// these is there, or more than one.
Layer chooseLayer(const std::vector<Part>& parts, bool asNumbers);

}  // namespace fluidtex::foreign
