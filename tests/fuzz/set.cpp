// --set options, a line each, over a scene that is right.
#include "scenes/scene.h"
#include "tests/fuzz/reader.h"

#include <sstream>

using namespace fluidtex;

namespace {

const std::string kScene =
    "texture.exemplar = 'e.png'\ndomain.size = [2, 1, 1]\n[[liquid]]\nbox = { min = [0, 0, 0], max = [1, 1, "
    "0.5] }\n";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto picture = fuzz::written("e.png", nullptr, 0);
  static const auto file =
      fuzz::written("scene.toml", reinterpret_cast<const std::uint8_t*>(kScene.data()), kScene.size());
  scenes::Overrides overrides;
  std::istringstream lines(std::string(reinterpret_cast<const char*>(data), size));
  for (std::string line; std::getline(lines, line) && overrides.set.size() < 20;)
    overrides.set.push_back(line);
  try {
    scenes::loadScene(file, overrides);
  } catch (const scenes::SceneError& error) {
    for (const std::string& fault : error.faults) fuzz::checkSentence(fault);
  }
  return 0;
}
