#include "foreign/picture.h"

#include "tests/foreign/profiles.h"
#include "tests/scratch.h"

#include <OpenImageIO/imageio.h>
#include <libheif/heif.h>
#include <webp/mux.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>

#include <jpeglib.h>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace {

constexpr int kWidth = 24, kHeight = 16;

// Different at every place and in every channel.
float stored(int x, int y, int channel) {
  return float((x * 7 + y * 11 + channel * 50) % 220 + 20) / 255.0f;
}

std::vector<float> pixels(const ImageSpec& spec) {
  std::vector<float> data;
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x)
      for (int c = 0; c < spec.nchannels; ++c) data.push_back(stored(x, y, c));
  return data;
}

std::filesystem::path write(const Scratch& scratch, const std::string& name, const ImageSpec& spec) {
  const std::string file = (scratch.path / name).string();
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output->open(file, spec));
  REQUIRE(output->write_image(TypeDesc::FLOAT, pixels(spec).data()));
  REQUIRE(output->close());
  return file;
}

ImageSpec rgb(TypeDesc type = TypeDesc::UINT8, int channels = 3) {
  ImageSpec spec(kWidth, kHeight, channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // written as it is
  return spec;
}

ImageSpec withProfile(ImageSpec spec, const Bytes& profile) {
  spec.attribute("ICCProfile", TypeDesc(TypeDesc::UINT8, int(profile.size())), profile.data());
  return spec;
}

// As floats 0..1.
std::vector<float> pixel(const Picture& picture, int x, int y) {
  std::vector<float> values;
  const std::size_t size = picture.sampleSize();
  const char* at = picture.samples.data() + (std::size_t(y) * std::size_t(picture.width) + std::size_t(x)) *
                                                std::size_t(picture.channels) * size;
  for (int c = 0; c < picture.channels; ++c, at += size) {
    if (picture.sample == Sample::byte) values.push_back(float(static_cast<unsigned char>(*at)) / 255.0f);
    std::uint16_t word = 0;
    if (picture.sample == Sample::word)
      std::memcpy(&word, at, size), values.push_back(float(word) / 65535.0f);
    float real = 0.0f;
    if (picture.sample == Sample::real) std::memcpy(&real, at, size), values.push_back(real);
  }
  return values;
}

// The picture's channels are these of what was written, from this corner on.
void checkShows(const Picture& picture, int left, int top, int width, int height, int firstChannel) {
  REQUIRE(picture.width == width);
  REQUIRE(picture.height == height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::vector<float> values = pixel(picture, x, y);
      for (int c = 0; c < picture.channels; ++c)
        if (std::abs(values[std::size_t(c)] - stored(left + x, top + y, firstChannel + c)) > 2e-3f)
          FAIL(x << " " << y << " " << c << ": " << values[std::size_t(c)]);
    }
}

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string little(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i));
  return text;
}

// 5 x 1 pixels of four bytes: blue, green, red and `fourth`.
std::string rows32(char fourth) {
  std::string text;
  for (int x = 0; x < 5; ++x) text += {char(10 * x), char(100), char(200), fourth};
  return text;
}

std::string bitmap(char fourth, bool saysAlpha) {
  std::string header = little(saysAlpha ? 108 : 40, 4) + little(5, 4) + little(1, 4) + little(1, 2) +
                       little(32, 2) + little(saysAlpha ? 3 : 0, 4) + std::string(20, '\0');
  if (saysAlpha)
    header += little(0xff0000, 4) + little(0xff00, 4) + little(0xff, 4) + little(0xff000000, 4) +
              std::string(52, '\0');
  const std::uint32_t start = std::uint32_t(14 + header.size());
  return "BM" + little(start + 20, 4) + little(0, 4) + little(start, 4) + header + rows32(fourth);
}

std::string targa(char fourth, bool saysAlpha) {
  return std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + little(5, 2) + little(1, 2) + char(32) +
         char(0x20 | (saysAlpha ? 8 : 0)) + rows32(fourth);
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

TEST_CASE("pictures: what is stored comes as it is stored", "[foreign]") {
  const Scratch scratch;
  const Picture byte = readColors(write(scratch, "a.png", rgb()));
  CHECK(byte.sample == Sample::byte);
  CHECK(byte.curve == Curve::srgb);
  checkShows(byte, 0, 0, kWidth, kHeight, 0);
  const Picture word = readColors(write(scratch, "b.png", rgb(TypeDesc::UINT16, 4)));
  CHECK(word.sample == Sample::word);
  CHECK(word.channels == 4);
  checkShows(word, 0, 0, kWidth, kHeight, 0);
  const Picture real = readColors(write(scratch, "c.exr", rgb(TypeDesc::HALF)));
  CHECK(real.sample == Sample::real);
  CHECK(real.curve == Curve::linear);
  checkShows(real, 0, 0, kWidth, kHeight, 0);
}

TEST_CASE("pictures: an EXR's layer and part are taken by their names", "[foreign]") {
  const Scratch scratch;
  ImageSpec layers = rgb(TypeDesc::HALF, 6);
  layers.channelnames = {"albedo.R", "albedo.G", "albedo.B", "rgba.R", "rgba.G", "rgba.B"};
  checkShows(readColors(write(scratch, "layers.exr", layers)), 0, 0, kWidth, kHeight, 3);
  layers.channelnames = {"albedo.R", "albedo.G", "albedo.B", "normal.R", "normal.G", "normal.B"};
  CHECK_THROWS_WITH(readColors(write(scratch, "none.exr", layers)), Contains("albedo, normal"));

  const std::string file = (scratch.path / "parts.exr").string();
  ImageSpec parts[2] = {rgb(TypeDesc::HALF, 1), rgb(TypeDesc::HALF)};
  parts[0].channelnames = {"Z"};
  parts[0].attribute("oiio:subimagename", "depth");
  parts[1].attribute("oiio:subimagename", "rgba");
  const auto output = OIIO::ImageOutput::create(file);
  REQUIRE(output->open(file, 2, parts));
  REQUIRE(output->write_image(TypeDesc::FLOAT, pixels(parts[0]).data()));
  REQUIRE(output->open(file, parts[1], OIIO::ImageOutput::AppendSubimage));
  REQUIRE(output->write_image(TypeDesc::FLOAT, pixels(parts[1]).data()));
  REQUIRE(output->close());
  const Picture beauty = readColors(file);
  CHECK(beauty.channels == 3);
  checkShows(beauty, 0, 0, kWidth, kHeight, 0);
}

TEST_CASE("pictures: of an EXR what lies inside its display window", "[foreign]") {
  const Scratch scratch;
  ImageSpec over = rgb(TypeDesc::HALF);
  over.full_x = 4;
  over.full_y = 2;
  over.full_width = 10;
  over.full_height = 12;
  checkShows(readColors(write(scratch, "over.exr", over)), 4, 2, 10, 12, 0);
  // What is not stored is not made up.
  ImageSpec part = rgb(TypeDesc::HALF);
  part.x = 5;
  part.full_width = 100;
  part.full_height = 100;
  checkShows(readColors(write(scratch, "part.exr", part)), 0, 0, kWidth, kHeight, 0);
  ImageSpec beside = rgb(TypeDesc::HALF);
  beside.full_x = 1000;
  beside.full_width = 10;
  beside.full_height = 10;
  CHECK_THROWS_WITH(readColors(write(scratch, "beside.exr", beside)), Contains("display window"));
}

TEST_CASE("pictures: a colour profile's meaning, not its numbers", "[foreign]") {
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

TEST_CASE("pictures: a profile keeps alpha, and colours multiplied by it", "[foreign]") {
  const Scratch scratch;
  const Picture straight = readColors(
      write(scratch, "a.png", withProfile(rgb(TypeDesc::UINT16, 4), rgbProfile(kSrgbPrimaries, 2.0))));
  REQUIRE(straight.channels == 4);
  CHECK(straight.straight != 0);
  CHECK_THAT(pixel(straight, 2, 3)[3], WithinAbs(stored(2, 3, 3), 1e-4));
}

TEST_CASE("pictures: a profile that cannot be used is told, and the picture read as sRGB", "[foreign]") {
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

TEST_CASE("pictures: primaries that an EXR names", "[foreign]") {
  const Scratch scratch;
  ImageSpec spec = rgb(TypeDesc::FLOAT);
  const float p3[8] = {0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f};
  spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), p3);
  const Picture wide = readColors(write(scratch, "p3.exr", spec));
  double wanted = 0.0;
  for (int c = 0; c < 3; ++c) wanted += kP3ToSrgb[1][c] * double(stored(9, 5, c));
  CHECK_THAT(pixel(wide, 9, 5)[1], WithinAbs(wanted, 3e-3));
}

TEST_CASE("pictures: the colours of an AVIF or HEIC file, by profile or by code", "[foreign]") {
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

TEST_CASE("pictures: inks, inverted with Adobe's mark and as they are without", "[foreign]") {
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

TEST_CASE("pictures: a TIFF of inks with their profile", "[foreign]") {
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

TEST_CASE("pictures: the orientation that a WebP file says", "[foreign]") {
  const Scratch scratch;
  const auto plain = write(scratch, "plain.webp", rgb());
  CHECK(readColors(plain).orientation == 1);
  const std::string bytes = readBytes(plain);
  const WebPData whole{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  WebPMux* mux = WebPMuxCreate(&whole, 1);
  REQUIRE(mux);
  // A directory of one entry: 0x0112, a short, 6.
  const std::string exif("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0", 26);
  for (const std::string& text : {exif, std::string("Exif\0\0", 6) + exif}) {
    const WebPData chunk{reinterpret_cast<const uint8_t*>(text.data()), text.size()};
    REQUIRE(WebPMuxSetChunk(mux, "EXIF", &chunk, 1) == WEBP_MUX_OK);
    WebPData made;
    REQUIRE(WebPMuxAssemble(mux, &made) == WEBP_MUX_OK);
    writeBytes(scratch.path / "turned.webp", {reinterpret_cast<const char*>(made.bytes), made.size});
    WebPDataClear(&made);
    CHECK(readColors(scratch.path / "turned.webp").orientation == 6);
  }
  WebPMuxDelete(mux);
}

TEST_CASE("pictures: bytes that pad a pixel are no alpha, unless the file says so", "[foreign]") {
  const Scratch scratch;
  const auto shown = [&](const char* name, const std::string& bytes) {
    writeBytes(scratch.path / name, bytes);
    return readColors(scratch.path / name);
  };
  for (const Picture& padded : {shown("pad.bmp", bitmap(0, false)), shown("pad.tga", targa(0, false))}) {
    CHECK(padded.channels == 3);
    CHECK_THAT(pixel(padded, 4, 0)[0], WithinAbs(200.0 / 255.0, 1e-4));
    CHECK_THAT(pixel(padded, 4, 0)[2], WithinAbs(40.0 / 255.0, 1e-4));
  }
  for (const Picture& clear : {shown("clear.bmp", bitmap(0, true)), shown("clear.tga", targa(0, true))}) {
    REQUIRE(clear.channels == 4);
    CHECK(pixel(clear, 4, 0)[3] == 0.0f);
  }
  for (const Picture& veiled :
       {shown("half.bmp", bitmap(100, false)), shown("half.tga", targa(100, false)),
        shown("half2.bmp", bitmap(100, true)), shown("half2.tga", targa(100, true))}) {
    REQUIRE(veiled.channels == 4);
    CHECK(veiled.straight != 0);
    CHECK_THAT(pixel(veiled, 4, 0)[0], WithinAbs(200.0 / 255.0, 1e-4));
  }
}
