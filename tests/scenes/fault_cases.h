// Texts with one fault each, and what is to be said of it.
#pragma once

#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace fluidtex::scenes {

struct Case {
  std::string text;   // after the five lines of kGoodScene
  std::string fault;  // the only one
};

inline void checkCases(const std::vector<Case>& cases) {
  for (const Case& wrong : cases) {
    INFO(wrong.text);
    CHECK(faultsOf(kGoodScene + wrong.text) == std::vector<std::string>{wrong.fault});
  }
}

inline void checkWholeFiles(const std::vector<Case>& cases) {
  for (const Case& wrong : cases) {
    INFO(wrong.text);
    CHECK(faultsOf(wrong.text) == std::vector<std::string>{wrong.fault});
  }
}

}  // namespace fluidtex::scenes
