// A picture of any kind: the library that is asked tells by its content which.
#include "foreign/picture.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::written("picture", data, size);
  return fuzz::outcomeFromAfar<foreign::Unreadable>([&] {
    const foreign::Picture picture = foreign::readColors(file);
    std::string words = fuzz::magnitude(picture.width) + fuzz::magnitude(picture.height);
    for (const int part :
         {picture.channels, int(picture.sample), int(picture.curve), picture.orientation, picture.straight})
      words += char('a' + part);
    return words;
  });
}
