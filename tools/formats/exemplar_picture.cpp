#include "tools/formats/exemplar_picture.h"

#include "render/frame_name.h"
#include "texture/exemplar/srgb.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace fluidtex::tools {
namespace {

std::string encodedPng(const texture::Image& size, png_uint_32 format, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(size.width);
  image.height = static_cast<png_uint_32>(size.height);
  image.format = format;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t length = bytes.size();
  if (!png_image_write_to_memory(&image, bytes.data(), &length, 0, pixels, 0, nullptr))
    throw std::runtime_error(std::string("the exemplar cannot be written as PNG: ") + image.message);
  bytes.resize(length);
  return bytes;
}

}  // namespace

std::string exemplarFile(int frame) {
  return std::string(kMovingExemplar) + "/" + render::frameName(frame) + ".png";
}

bool isSeeThrough(const texture::Image& color) {
  for (std::size_t i = 3; i < color.data.size(); i += 4)
    if (color.data[i] < 1.0f) return true;
  return false;
}

std::string pngOf(const texture::Image& color) {
  const std::size_t channels = isSeeThrough(color) ? 4 : 3;
  std::vector<png_byte> pixels;
  pixels.reserve(color.data.size() / 4 * channels);
  for (std::size_t i = 0; i < color.data.size(); ++i) {
    if (i % 4 >= channels) continue;
    const float value = i % 4 < 3 ? texture::encodeSrgb(color.data[i]) : color.data[i];
    pixels.push_back(static_cast<png_byte>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))));
  }
  return encodedPng(color, channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB, pixels.data());
}

std::string pngOfNumbers(const texture::Image& map) {
  std::vector<png_uint_16> pixels;
  pixels.reserve(map.data.size());
  for (const float value : map.data)
    pixels.push_back(static_cast<png_uint_16>(std::lround(65535.0f * std::clamp(value, 0.0f, 1.0f))));
  return encodedPng(map,
                    map.channels == 1 ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_LINEAR_Y | PNG_FORMAT_FLAG_COLOR,
                    pixels.data());
}

}  // namespace fluidtex::tools
