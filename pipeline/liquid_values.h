// The liquid's own scalars on its textured surface: temperature, and what files have besides.
#pragma once

#include "sim/frame/frame.h"
#include "texture/surface.h"

#include <map>
#include <string>
#include <vector>

namespace fluidtex::pipeline {

// Adds the frame's fields at the vertices as maps of their names, interpolated linearly. A name that vertices
// or the exemplar's maps have already gets "liquid_" before it.
void addLiquidValues(const sim::Frame& frame, texture::TexturedSurface& surface);

// Values of the same names that are known at each vertex (#V each), in place of interpolated ones.
void setLiquidValues(const std::map<std::string, std::vector<float>>& values,
                     texture::TexturedSurface& surface);

}  // namespace fluidtex::pipeline
