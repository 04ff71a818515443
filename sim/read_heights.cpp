#include "sim/read_heights.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

namespace {

constexpr int kLargestSide = 16384;

}  // namespace

HeightImage readHeights(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (!std::filesystem::exists(file)) throw HeightError(name + ": no such file");
  if (!std::filesystem::is_regular_file(file)) throw HeightError(name + ": not a file");
  const auto input = OIIO::ImageInput::open(name);
  if (!input) {
    OIIO::geterror();  // The library prints what nobody has fetched.
    throw HeightError(name + ": cannot be read as an image");
  }
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 2 || spec.height < 2 || spec.depth > 1 || spec.deep)
    throw HeightError(name + ": is no picture of at least 2 x 2 pixels");
  if (spec.width > kLargestSide || spec.height > kLargestSide)
    throw HeightError(name + ": is larger than " + std::to_string(kLargestSide) + " pixels a side");
  HeightImage image{spec.width, spec.height,
                    std::vector<float>(std::size_t(spec.width) * std::size_t(spec.height))};
  if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, image.values.data())) {
    input->geterror();
    throw HeightError(name + ": is damaged or cut short");
  }
  if (!std::all_of(image.values.begin(), image.values.end(), [](float v) { return std::isfinite(v); }))
    throw HeightError(name + ": holds a value that is not a finite number");
  return image;
}

}  // namespace fluidtex::sim
