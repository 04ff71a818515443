// A picture of any kind: the library that is asked tells by its content which.
#include "foreign/picture.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::written("picture", data, size);
  return fuzz::outcomeOf<foreign::Unreadable>([&] { foreign::readColors(file); });
}
