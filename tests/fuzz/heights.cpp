// Heights from a picture.
#include "sim/shapes/read_heights.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::written("heights.png", data, size);
  return fuzz::outcomeFromAfar<sim::HeightError>([&] {
    const sim::HeightImage image = sim::readHeights(file);
    return fuzz::magnitude(image.width) + fuzz::magnitude(image.height) +
           fuzz::magnitude(image.values.front());
  });
}
