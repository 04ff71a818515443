// Texts for damaged files.
#pragma once

#include <string>

namespace fluidtex::scenes {

inline std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

}  // namespace fluidtex::scenes
