#include "render/frame_name.h"

#include <charconv>
#include <cstdio>

namespace fluidtex::render {

std::string frameName(int frame) {
  char name[16];
  std::snprintf(name, sizeof name, "%04d", frame);
  return name;
}

std::optional<int> frameNumber(std::string_view name) {
  int frame = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), frame);
  if (error != std::errc() || frame < 0 || frameName(frame) != name) return std::nullopt;
  return frame;
}

}  // namespace fluidtex::render
