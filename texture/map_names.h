// Names of an exemplar's further maps, which become properties of a PLY's vertices.
#pragma once

#include "texture/surface.h"

#include <set>
#include <string>
#include <vector>

namespace fluidtex::texture {

// Whether the name is reserved: that of a vertex property that every PLY has, or may have.
inline bool isReservedName(const std::string& name) {
  static const std::set<std::string> kNames = {
      "x",       "y",        "z",       "nx",      "ny",      "nz",      "red",    "green",  "blue",
      "alpha",   "s",        "t",       "dx",      "dy",      "dz",      "bx",     "by",     "bz",
      "vx",      "vy",       "vz",      "trust",   "age",     "contact", "fade_s", "fade_t", "fade",
      "scale",   "guidance", "foam",    "sx",      "sy",      "sz",      "tx",     "ty",     "tz",
      "fade_sx", "fade_sy",  "fade_sz", "fade_tx", "fade_ty", "fade_tz"};
  return kNames.contains(name);
}

// Names of a vector's three components in a PLY.
inline std::vector<std::string> vectorNames(const std::string& name) {
  return {name + "_x", name + "_y", name + "_z"};
}

}  // namespace fluidtex::texture
