#include "tools/stress_scenes/scene_text.h"

#include <fmt/core.h>

namespace fluidtex::stress {

std::string text(double x) {
  return fmt::format("{:.9g}", x);  // as many digits as the domain's size: what reaches its sides does so
}

std::string text(const Vec3d& x) {
  return fmt::format("[{}, {}, {}]", text(x[0]), text(x[1]), text(x[2]));
}

std::string box(const Vec3d& low, const Vec3d& high) {
  return fmt::format("box = {{ min = {}, max = {} }}", text(low), text(high));
}

std::string sphere(const Vec3d& center, double radius) {
  return fmt::format("sphere = {{ center = {}, radius = {} }}", text(center), text(radius));
}

std::string cylinder(const Vec3d& from, const Vec3d& to, double radius) {
  return fmt::format("cylinder = {{ from = {}, to = {}, radius = {} }}", text(from), text(to), text(radius));
}

std::string joined(const char* how, std::initializer_list<std::string> parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "{ " : ", { ") + part + " }";
  return fmt::format("{} = [{}]", how, all);
}

}  // namespace fluidtex::stress
