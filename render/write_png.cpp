#include "render/render.h"
#include "texture/exemplar/srgb.h"

#include <png.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace fluidtex::render {
namespace {

std::uint8_t encoded(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0f * texture::encodeSrgb(std::clamp(linear, 0.0f, 1.0f))));
}

// In memory, so that what the disk refuses is known by its own error.
struct PngFile {
  std::vector<char> bytes;
  std::string fault;
};

void append(png_structp png, png_bytep data, std::size_t size) {
  auto& bytes = static_cast<PngFile*>(png_get_io_ptr(png))->bytes;
  bool fits = true;
  try {
    bytes.insert(bytes.end(), data, data + size);
  } catch (const std::exception&) {
    fits = false;
  }
  // Not in the handler, which must not be left by longjmp().
  if (!fits) png_error(png, "out of memory");
}

[[noreturn]] void refuse(png_structp png, png_const_charp why) {
  static_cast<PngFile*>(png_get_error_ptr(png))->fault = why;
  png_longjmp(png, 1);
}

// What it warns of is said where it fails.
void pass(png_structp, png_const_charp) {}

// libpng leaves through longjmp() where something is wrong: nothing here has a destructor.
void encode(png_structp png, png_infop info, PngFile& file, int width, int height, png_bytepp rows,
            png_textp notes, int noteCount) {
  if (setjmp(png_jmpbuf(png)) != 0) return;
  png_set_write_fn(png, &file, append, nullptr);
  png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  // Noise hardly packs: the low levels are nearly as small as the high ones and several times as fast.
  png_set_compression_level(png, 3);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
  png_set_text(png, info, notes, noteCount);
  png_write_info(png, info);
  png_write_image(png, rows);
  png_write_end(png, nullptr);
}

// As tEXt, which is Latin-1, where it is ASCII; else as iTXt, which is UTF-8.
png_text noteOf(PictureNote& note) {
  png_text text{};
  const bool ascii =
      std::all_of(note.text.begin(), note.text.end(), [](unsigned char c) { return c < 0x80; });
  text.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
  text.key = note.key.data();
  text.text = note.text.data();
  if (ascii) text.text_length = note.text.size();
  return text;
}

}  // namespace

void writePng(const Picture& picture, const std::filesystem::path& file, std::vector<PictureNote> notes) {
  std::vector<std::uint8_t> pixels(picture.rgb.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels.size(), 1 << 14), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) pixels[i] = encoded(picture.rgb[i]);
  });
  std::vector<png_bytep> rows;
  rows.reserve(std::size_t(picture.height));
  for (int y = 0; y < picture.height; ++y) rows.push_back(&pixels[std::size_t(y) * picture.width * 3]);
  std::vector<png_text> texts;
  texts.reserve(notes.size());
  for (PictureNote& note : notes) texts.push_back(noteOf(note));

  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file.string() + ": the picture could not be written: " + why);
  };
  PngFile content;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &content, refuse, pass);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info != nullptr)
    encode(png, info, content, picture.width, picture.height, rows.data(), texts.data(), int(texts.size()));
  else
    content.fault = "out of memory";
  png_destroy_write_struct(&png, &info);
  if (!content.fault.empty()) fail(content.fault);
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out.write(content.bytes.data(), static_cast<std::streamsize>(content.bytes.size()));
  out.close();
  if (!out) fail(std::strerror(errno));
}

}  // namespace fluidtex::render
