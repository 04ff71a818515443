#include "foreign/ink_jpeg.h"

#include "foreign/unreadable.h"

#include <cstdio>

#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <memory>
#include <string>

namespace fluidtex::foreign {
namespace {

struct Errors {
  jpeg_error_mgr base;
  std::jmp_buf back;
  char words[JMSG_LENGTH_MAX] = {};
};

[[noreturn]] void giveUp(j_common_ptr info) {
  auto* errors = reinterpret_cast<Errors*>(info->err);
  info->err->format_message(info, errors->words);
  std::longjmp(errors->back, 1);
}

// Bytes between two parts harm nothing.
void countDamage(j_common_ptr info, int level) {
  if (level < 0 && info->err->msg_code != JWRN_EXTRANEOUS_DATA) ++info->err->num_warnings;
}

// Nothing here has a destructor: the library leaves by a jump.
bool decode(std::FILE* in, jpeg_decompress_struct& info, Errors& errors, Inks& inks) {
  if (setjmp(errors.back) != 0) return false;
  jpeg_create_decompress(&info);
  jpeg_stdio_src(&info, in);
  jpeg_read_header(&info, TRUE);
  info.out_color_space = JCS_CMYK;
  jpeg_start_decompress(&info);
  inks.width = int(info.output_width);
  inks.height = int(info.output_height);
  const std::size_t row = std::size_t(inks.width) * 4;
  inks.cmyk.resize(row * std::size_t(inks.height));
  while (info.output_scanline < info.output_height) {
    JSAMPROW into = inks.cmyk.data() + info.output_scanline * row;
    jpeg_read_scanlines(&info, &into, 1);
  }
  return true;
}

}  // namespace

Inks readInkJpeg(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"), std::fclose);
  if (!in) throw Unreadable("cannot be read as an image");
  Inks inks;
  jpeg_decompress_struct info{};
  Errors errors{};
  info.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = giveUp;
  errors.base.emit_message = countDamage;
  const bool whole = decode(in.get(), info, errors, inks);
  const bool inverted = info.saw_Adobe_marker;
  const long warnings = errors.base.num_warnings;
  jpeg_destroy_decompress(&info);
  if (!whole) throw Unreadable("is damaged or cut short: " + asClause(errors.words));
  if (warnings > 0) throw Unreadable("is damaged or cut short");
  if (inverted)
    for (unsigned char& ink : inks.cmyk) ink = static_cast<unsigned char>(255 - ink);
  return inks;
}

}  // namespace fluidtex::foreign
