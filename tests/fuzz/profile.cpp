// A colour profile.
#include "foreign/color_profile.h"
#include "tests/fuzz/reader.h"

#include <algorithm>

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const unsigned char> icc(data, size);
  const int channels = std::max(1, foreign::profileChannels(icc));
  return fuzz::outcomeOf<foreign::Unreadable>([&] {
    const foreign::ColorProfile profile(icc, channels);
    const float in[4] = {0.2f, 0.5f, 1.0f, 0.0f};
    float out[3];
    profile.toLinear(in, 1, out);
  });
}
