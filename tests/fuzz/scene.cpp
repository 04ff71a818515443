// The text of a scene file.
#include "scenes/scene.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto picture = fuzz::written("e.png", nullptr, 0);  // only its presence is looked at
  const auto file = fuzz::written("scene.toml", data, size);
  try {
    scenes::loadScene(file);
  } catch (const scenes::SceneError& error) {
    for (const std::string& fault : error.faults) fuzz::checkSentence(fault);
  }
  return 0;
}
