#include "foreign/ask.h"

#include "foreign/grid.h"
#include "foreign/picture.h"
#include "tests/scratch.h"

#include <OpenImageIO/imageio.h>
#include <openvdb/openvdb.h>

#include <catch2/catch.hpp>

#include <sys/stat.h>
#include <sys/wait.h>

#include <random>
#include <thread>

using namespace fluidtex::foreign;
using Catch::Matchers::Contains;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimited = false;  // in memory: the sanitizers take all addresses for themselves
#else
constexpr bool kLimited = true;
#endif

void writeBytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string big(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += char(value >> (8 * i));
  return text;
}

// A picture of 8 x 8 in runs, whose rows are one byte long: 127 values follow, it says, and the file ends.
// The library's reader asserts that they do.
std::string crashingPicture() {
  std::string bytes = big(0x01da, 2) + big(1, 1) + big(1, 1) + big(3, 2) + big(8, 2) + big(8, 2) + big(1, 2) +
                      big(0, 4) + big(255, 4);
  bytes.resize(512);
  for (int row = 0; row < 8; ++row) bytes += big(512 + 64, 4);
  for (int row = 0; row < 8; ++row) bytes += big(1, 4);
  return bytes + '\xff';
}

std::filesystem::path writePicture(const std::filesystem::path& file, int size = 32) {
  const auto output = OIIO::ImageOutput::create(file.string());
  const OIIO::ImageSpec spec(size, size, 3, OIIO::TypeDesc::UINT8);
  std::vector<unsigned char> data;
  for (int i = 0; i < size * size * 3; ++i) data.push_back(static_cast<unsigned char>(i * 37 % 251));
  REQUIRE(output);
  REQUIRE(output->open(file.string(), spec));
  REQUIRE(output->write_image(OIIO::TypeDesc::UINT8, data.data()));
  REQUIRE(output->close());
  return file;
}

// Reads it, or refuses it in words that go on behind the file's name.
void survive(const std::filesystem::path& file) {
  try {
    const Picture picture = readColors(file);
    CHECK(picture.width > 0);
  } catch (const Unreadable& error) {
    const std::string words = error.what();
    CHECK(words.find('\n') == words.npos);
    CHECK_FALSE(words.ends_with("."));
    CHECK(words.size() < 1000);
  }
}

}  // namespace

TEST_CASE("ask: a library that crashes ends its own process, and the next file is read", "[foreign]") {
  const Scratch scratch;
  const auto good = writePicture(scratch.path / "good.png");
  writeBytes(scratch.path / "crash.sgi", crashingPicture());
  for (int time = 0; time < 2; ++time) {
    CHECK_THROWS_WITH(readColors(scratch.path / "crash.sgi"), Contains("crashes on it"));
    CHECK(readColors(good).width == 32);
  }
}

TEST_CASE("ask: the library's own reason is told", "[foreign]") {
  const Scratch scratch;
  writeBytes(scratch.path / "words.png", "hello\n");
  CHECK_THROWS_WITH(readColors(scratch.path / "words.png"),
                    Contains("cannot be read as an image: ") && Contains("PNG"));
  for (const char* name : {"cut.tif", "cut.jpg", "cut.png", "cut.bmp", "cut.exr", "cut.gif", "cut.webp"}) {
    INFO(name);
    const auto cut = writePicture(scratch.path / name, 64);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) * 2 / 3);
    CHECK_THROWS_AS(readColors(cut), Unreadable);
  }
  CHECK_THROWS_AS(readColors(scratch.path / "missing.png"), Unreadable);
  CHECK_THROWS_AS(readColors(std::string(100000, 'a')), Unreadable);
}

TEST_CASE("ask: damaged pictures of every kind are read or refused", "[foreign]") {
  const Scratch scratch;
  std::mt19937 random(7);
  for (const char* kind :
       {"sgi", "dpx", "gif", "bmp", "tga", "png", "jpg", "tif", "exr", "webp", "ppm", "hdr"}) {
    const std::string whole = readBytes(writePicture(scratch.path / (std::string("whole.") + kind)));
    const std::filesystem::path file = scratch.path / (std::string("damaged.") + kind);
    for (int round = 0; round < 12; ++round) {
      INFO(kind << ", round " << round);
      std::string bytes = whole;
      // In the header, where it hurts, and anywhere.
      for (int i = 0; i < 3; ++i) {
        bytes[random() % std::min<std::size_t>(bytes.size(), 64)] = char(random());
        bytes[random() % bytes.size()] = char(random());
      }
      if (round % 4 == 3) bytes.resize(random() % bytes.size());
      writeBytes(file, bytes);
      survive(file);
    }
  }
}

TEST_CASE("ask: a file that says much and holds little takes little", "[foreign]") {
  const Scratch scratch;
  // 16384 x 4096 pixels, says the header.
  writeBytes(scratch.path / "says.ppm", "P6\n16384 4096\n255\n" + std::string(3000, 'a'));
  survive(scratch.path / "says.ppm");
  writeBytes(scratch.path / "large.ppm", "P6\n99999 99999\n255\n" + std::string(3000, 'a'));
  CHECK_THROWS_WITH(readColors(scratch.path / "large.ppm"),
                    Contains("too large") && Contains("99999 x 99999"));
}

TEST_CASE("ask: what never comes to an end is ended", "[foreign][slow]") {
  const Scratch scratch;
  // A pipe that nobody writes to.
  REQUIRE(mkfifo((scratch.path / "pipe.png").c_str(), 0600) == 0);
  CHECK_THROWS_WITH(readColors(scratch.path / "pipe.png"), Contains("takes too long"));
  CHECK(readColors(writePicture(scratch.path / "good.png")).width == 32);
}

TEST_CASE("ask: several threads at once, and a child of the program", "[foreign]") {
  const Scratch scratch;
  const auto good = writePicture(scratch.path / "good.png");
  std::vector<std::thread> threads;
  std::vector<int> widths(8);
  for (int& width : widths) threads.emplace_back([&] { width = readColors(good).width; });
  for (std::thread& thread : threads) thread.join();
  CHECK(widths == std::vector<int>(8, 32));
  const pid_t child = fork();
  if (child == 0) {
    int code = 1;
    try {
      code = readColors(good).width == 32 ? 0 : 2;
    } catch (const Unreadable&) {
    }
    _exit(code);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(readColors(good).width == 32);
}

TEST_CASE("ask: grids that are as empty as can be have the memory that they take", "[foreign]") {
  openvdb::initialize();
  const Scratch scratch;
  const std::filesystem::path file = scratch.path / "sparse.vdb";
  for (const int count : {1, 10, 300}) {
    INFO(count);
    const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create();
    for (int i = 0; i < count; ++i)
      grid->tree().setValue(openvdb::Coord(5000 * i, 0, 0), openvdb::Vec3s(1.0f));
    openvdb::io::File(file.string()).write({grid});
    CHECK(readGrid(file, true).size() > std::size_t(count) * 400'000);
  }
}

TEST_CASE("ask: grids of OpenVDB files, whole and damaged", "[foreign]") {
  openvdb::initialize();
  const Scratch scratch;
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.5f);
  for (int i = 0; i < 40; ++i) grid->tree().setValue(openvdb::Coord(i, 2 * i, 40 - i), 0.1f * float(i));
  const std::filesystem::path file = scratch.path / "a.vdb";
  openvdb::io::File(file.string()).write({grid});
  CHECK(readGrid(file, false).size() > 1000);
  CHECK_THROWS_WITH(readGrid(file, true), Contains("holds no grid of float vectors"));
  CHECK_THROWS_WITH(readGrid(scratch.path / "none.vdb", false), Contains("OpenVDB"));

  // Its name has 800 MB, it says: nothing makes room for that.
  const std::string whole = readBytes(file);
  std::string named = whole;
  named.replace(named.find(std::string("\x10\0\0\0Tree_float_5", 16)), 4, std::string("\0\0\0\x30", 4));
  writeBytes(file, named);
  CHECK_THROWS_WITH(readGrid(file, false),
                    Contains(kLimited ? "more memory than a file of its size" : "OpenVDB"));

  for (const std::size_t missing : {1u, 9u, 99u, 999u}) {
    writeBytes(file, whole.substr(0, whole.size() - missing));
    CHECK_THROWS_WITH(readGrid(file, false), Contains("OpenVDB"));
  }

  std::mt19937 random(3);
  for (int round = 0; round < 40; ++round) {
    std::string bytes = whole;
    for (int i = 0; i < 4; ++i) bytes[random() % bytes.size()] = char(random());
    if (round % 8 == 7) bytes.resize(random() % bytes.size());
    writeBytes(file, bytes);
    try {
      const std::string stream = readGrid(file, false);
      CHECK_FALSE(stream.empty());
    } catch (const Unreadable&) {
    }
  }
}
