// Numbers and shapes in the words of a scene file.
#pragma once

#include "sim/options.h"

#include <initializer_list>
#include <string>

namespace fluidtex::stress {

using sim::Vec3d;

std::string text(double x);
std::string text(const Vec3d& x);

// Each a key with its value.
std::string box(const Vec3d& low, const Vec3d& high);
std::string sphere(const Vec3d& center, double radius);
std::string cylinder(const Vec3d& from, const Vec3d& to, double radius);

// how: "union", "difference"; the shapes that are joined that way.
std::string joined(const char* how, std::initializer_list<std::string> parts);

}  // namespace fluidtex::stress
