// Pictures of others that are damaged, or that cannot be followed wholly, as the program's user sees it.
#include "tests/tools/program.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

namespace {

std::filesystem::path writePicture(const std::filesystem::path& file, const std::string& profile = {}) {
  OIIO::ImageSpec spec(64, 64, 3, OIIO::TypeDesc::UINT8);
  if (!profile.empty())
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(profile.size())), profile.data());
  std::vector<std::uint8_t> data;
  for (int i = 0; i < 64 * 64 * 3; ++i) data.push_back(std::uint8_t(i * 37 % 251));
  const auto output = OIIO::ImageOutput::create(file.string());
  REQUIRE(output->open(file.string(), spec));
  REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, data.data()));
  REQUIRE(output->close());
  return file;
}

Finished checkWith(const std::filesystem::path& exemplar) {
  return runProgram({"check", kSmallScene, "--exemplar", exemplar.string()});
}

}  // namespace

TEST_CASE("fluidtex check: a colour profile that cannot be followed is warned of", "[tools]") {
  const Scratch scratch;
  const Finished plain = checkWith(writePicture(scratch.path / "plain.tif"));
  CHECK(plain.exitCode == 0);
  CHECK(plain.err.empty());
  const Finished odd = checkWith(writePicture(scratch.path / "odd.tif", "no profile at all"));
  CHECK(odd.exitCode == 0);
  CHECK_THAT(odd.err, Catch::StartsWith("warning: ") && Catch::Contains("odd.tif: the colour profile in it"));
}

TEST_CASE("fluidtex check: a picture that its library crashes on is refused in one sentence", "[tools]") {
  const Scratch scratch;
  // Runs that go on beyond the file's end, in a picture of 8 x 8.
  std::string bytes("\x01\xda\x01\x01\0\3\0\x08\0\x08\0\x01\0\0\0\0\0\0\0\xff", 20);
  bytes.resize(512);
  for (int row = 0; row < 8; ++row) bytes += std::string("\0\0\x02\x40", 4);
  for (int row = 0; row < 8; ++row) bytes += std::string("\0\0\0\x01", 4);
  std::ofstream(scratch.path / "runs.sgi", std::ios::binary) << bytes << '\xff';
  const Finished done = checkWith(scratch.path / "runs.sgi");
  CHECK(done.exitCode == 1);
  CHECK_THAT(done.err,
             Catch::Contains(": error: texture.exemplar: ") && Catch::Contains("runs.sgi cannot be read: "));
  CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
}
