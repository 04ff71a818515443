// What the numbers of a picture mean: by a profile, by codes or primaries that the file names, or as inks.
#include "foreign/picture.h"

#include "tests/foreign/picture_files.h"
#include "tests/foreign/profiles.h"
#include "tests/scratch.h"

#include <libheif/heif.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

#include <jpeglib.h>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace {

ImageSpec withProfile(ImageSpec spec, const Bytes& profile) {
  spec.attribute("ICCProfile", TypeDesc(TypeDesc::UINT8, int(profile.size())), profile.data());
  return spec;
}

// 16 x 8 pixels of half cyan and a tenth of black, all over.
void writeInks(const std::filesystem::path& file, bool mark, const Bytes& profile = {}) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  std::FILE* out = std::fopen(file.c_str(), "wb");
  jpeg_stdio_dest(&info, out);
  info.image_width = 16;
  info.image_height = 8;
  info.input_components = 4;
  info.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 100, TRUE);
  info.write_Adobe_marker = mark ? TRUE : FALSE;
  jpeg_start_compress(&info, TRUE);
  if (!profile.empty()) jpeg_write_icc_profile(&info, profile.data(), unsigned(profile.size()));
  std::vector<JSAMPLE> row;
  for (int x = 0; x < 16; ++x)
    for (const int ink : {128, 0, 0, 26}) row.push_back(JSAMPLE(mark ? 255 - ink : ink));
  for (int y = 0; y < 8; ++y) {
    JSAMPROW rows = row.data();
    jpeg_write_scanlines(&info, &rows, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  std::fclose(out);
}

// 64 x 64 pixels of one colour, Display P3 by a profile or by its codes; false where no encoder is there.
bool writeAvif(const std::filesystem::path& file, bool byProfile) {
  heif_context* context = heif_context_alloc();
  heif_encoder* encoder = nullptr;
  if (heif_context_get_encoder_for_format(context, heif_compression_AV1, &encoder).code != heif_error_Ok)
    return false;
  heif_encoder_set_lossless(encoder, 1);
  heif_encoder_set_parameter(encoder, "chroma", "444");
  heif_image* image = nullptr;
  heif_image_create(64, 64, heif_colorspace_RGB, heif_chroma_interleaved_RGB, &image);
  heif_image_add_plane(image, heif_channel_interleaved, 64, 64, 8);
  int stride = 0;
  std::uint8_t* rows = heif_image_get_plane(image, heif_channel_interleaved, &stride);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c)
        rows[y * stride + 3 * x + c] = std::array<std::uint8_t, 3>{200, 120, 90}[std::size_t(c)];
  const Bytes profile = rgbProfile(kP3Primaries, 0.0);
  heif_color_profile_nclx* codes = heif_nclx_color_profile_alloc();
  codes->color_primaries = heif_color_primaries_SMPTE_EG_432_1;
  codes->transfer_characteristics = heif_transfer_characteristic_IEC_61966_2_1;
  heif_encoding_options* options = heif_encoding_options_alloc();
  options->macOS_compatibility_workaround_no_nclx_profile = 0;
  if (byProfile)
    heif_image_set_raw_color_profile(image, "prof", profile.data(), profile.size());
  else
    heif_image_set_nclx_color_profile(image, options->output_nclx_profile = codes);
  const bool written =
      heif_context_encode_image(context, image, encoder, options, nullptr).code == heif_error_Ok &&
      heif_context_write_to_file(context, file.c_str()).code == heif_error_Ok;
  heif_encoding_options_free(options);
  heif_nclx_color_profile_free(codes);
  heif_image_release(image);
  heif_encoder_release(encoder);
  heif_context_free(context);
  return written;
}

}  // namespace

TEST_CASE("picture: a colour profile's meaning, not its numbers", "[foreign]") {
  const Scratch scratch;
  for (const char* name : {"linear.png", "linear.tif", "linear.jpg"}) {
    INFO(name);
    const Picture linear =
        readColors(write(scratch, name, withProfile(rgb(), rgbProfile(kSrgbPrimaries, 1.0))));
    CHECK(linear.curve == Curve::linear);
    if (std::string(name) != "linear.jpg") checkShows(linear, 0, 0, kWidth, kHeight, 0);
  }
  const Picture wide =
      readColors(write(scratch, "p3.png", withProfile(rgb(), rgbProfile(kP3Primaries, 1.0))));
  for (std::size_t row = 0; row < 3; ++row) {
    double wanted = 0.0;
    for (int c = 0; c < 3; ++c) wanted += kP3ToSrgb[row][c] * double(stored(9, 5, c));
    CHECK_THAT(pixel(wide, 9, 5)[row], WithinAbs(std::min(1.0, std::max(0.0, wanted)), 3e-3));
  }
  const Picture grey =
      readColors(write(scratch, "grey.png", withProfile(rgb(TypeDesc::UINT16, 1), greyProfile(1.8))));
  CHECK(grey.channels == 3);
  CHECK_THAT(pixel(grey, 3, 4)[1], WithinAbs(std::pow(stored(3, 4, 0), 1.8), 3e-3));

  // sRGB's own leaves the bytes as they are; as numbers no profile counts.
  const Picture plain =
      readColors(write(scratch, "srgb.png", withProfile(rgb(), rgbProfile(kSrgbPrimaries, 0.0))));
  CHECK(plain.sample == Sample::byte);
  CHECK(plain.curve == Curve::srgb);
  const Picture numbers =
      readNumbers(write(scratch, "n.png", withProfile(rgb(), rgbProfile(kP3Primaries, 1.0))));
  CHECK(numbers.sample == Sample::byte);
  checkShows(numbers, 0, 0, kWidth, kHeight, 0);
}

TEST_CASE("picture: a profile keeps alpha, and colours multiplied by it", "[foreign]") {
  const Scratch scratch;
  const Picture straight = readColors(
      write(scratch, "a.png", withProfile(rgb(TypeDesc::UINT16, 4), rgbProfile(kSrgbPrimaries, 2.0))));
  REQUIRE(straight.channels == 4);
  CHECK(straight.straight != 0);
  CHECK_THAT(pixel(straight, 2, 3)[3], WithinAbs(stored(2, 3, 3), 1e-4));
}

TEST_CASE("picture: a profile that cannot be used is told, and the picture read as sRGB", "[foreign]") {
  const Scratch scratch;
  CHECK(colorNote(write(scratch, "plain.tif", rgb())).empty());
  CHECK(colorNote(write(scratch, "good.tif", withProfile(rgb(), rgbProfile(kP3Primaries, 2.2)))).empty());
  Bytes damaged = rgbProfile(kP3Primaries, 2.2);
  damaged.resize(140);
  const auto file = write(scratch, "bad.tif", withProfile(rgb(), damaged));
  CHECK_THAT(colorNote(file), Contains("profile") && Contains("damaged"));
  CHECK(readColors(file).curve == Curve::srgb);
  CHECK_THAT(colorNote(write(scratch, "inks.tif", withProfile(rgb(), inkProfile()))), Contains("CMYK"));
}

TEST_CASE("picture: primaries that an EXR names", "[foreign]") {
  const Scratch scratch;
  ImageSpec spec = rgb(TypeDesc::FLOAT);
  const float p3[8] = {0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f};
  spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), p3);
  const Picture wide = readColors(write(scratch, "p3.exr", spec));
  double wanted = 0.0;
  for (int c = 0; c < 3; ++c) wanted += kP3ToSrgb[1][c] * double(stored(9, 5, c));
  CHECK_THAT(pixel(wide, 9, 5)[1], WithinAbs(wanted, 3e-3));
}

TEST_CASE("picture: the colours of an AVIF or HEIC file, by profile or by code", "[foreign]") {
  const Scratch scratch;
  const auto linear = [](double v) { return std::pow((v / 255.0 + 0.055) / 1.055, 2.4); };
  for (const bool byProfile : {true, false}) {
    INFO("by profile " << byProfile);
    const auto file = scratch.path / "p3.avif";
    if (!writeAvif(file, byProfile)) {
      WARN("no encoder of AVIF here");
      return;
    }
    const Picture picture = readColors(file);
    CHECK(picture.curve == Curve::linear);
    const double p3[3] = {linear(200), linear(120), linear(90)};
    for (std::size_t row = 0; row < 3; ++row) {
      double wanted = 0.0;
      for (std::size_t c = 0; c < 3; ++c) wanted += kP3ToSrgb[row][c] * p3[c];
      CHECK_THAT(pixel(picture, 30, 30)[row], WithinAbs(wanted, 0.01));
    }
  }
}

TEST_CASE("picture: inks, inverted with Adobe's mark and as they are without", "[foreign]") {
  const Scratch scratch;
  for (const bool mark : {true, false}) {
    INFO("mark " << mark);
    writeInks(scratch.path / "inks.jpg", mark);
    const Picture mixed = readColors(scratch.path / "inks.jpg");
    REQUIRE(mixed.channels == 3);
    const double paper = 1.0 - 26.0 / 255.0;
    CHECK_THAT(pixel(mixed, 4, 4)[0], WithinAbs(paper * (1.0 - 128.0 / 255.0), 0.02));
    CHECK_THAT(pixel(mixed, 4, 4)[1], WithinAbs(paper, 0.02));

    writeInks(scratch.path / "profile.jpg", mark, inkProfile());
    const Picture light = readColors(scratch.path / "profile.jpg");
    CHECK(light.curve == Curve::linear);
    // L = 100 (1 - 26/255), whatever the cyan.
    const double y = std::pow((100.0 * paper + 16.0) / 116.0, 3.0);
    for (const float value : pixel(light, 4, 4)) CHECK_THAT(value, WithinAbs(y, 0.03));
  }
}

TEST_CASE("picture: a TIFF of inks with their profile", "[foreign]") {
  const Scratch scratch;
  const std::string file = (scratch.path / "inks.tif").string();
  ImageSpec spec = withProfile(rgb(), inkProfile());
  spec.attribute("tiff:ColorSpace", "CMYK");  // half of black: the writer turns grey into that
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output->open(file, spec));
  REQUIRE(output->write_image(TypeDesc::FLOAT, std::vector<float>(kWidth * kHeight * 3, 0.5f).data()));
  REQUIRE(output->close());
  CHECK(colorNote(file).empty());
  const Picture picture = readColors(file);
  REQUIRE(picture.channels == 3);
  CHECK(picture.curve == Curve::linear);
  for (const float value : pixel(picture, 7, 7)) CHECK_THAT(value, WithinAbs(0.184, 0.01));
}
