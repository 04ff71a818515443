// Damaged files: whatever a file holds, it is read or refused with a sentence.
#include "caches/formats/format_error.h"
#include "caches/formats/geometry_formats.h"
#include "tests/caches/formats/pyramid_files.h"
#include "tests/mutated.h"

#include <catch2/catch.hpp>

#include <chrono>

using namespace fluidtex::caches;

namespace {

// What readers of these formats stumble over.
const std::vector<std::string> kWords{"-1",
                                      "0",
                                      "4294967295",
                                      "1e308",
                                      "nan",
                                      "18446744073709551615",
                                      "\n",
                                      std::string(4, '\xFF'),
                                      std::string(4, '\0'),
                                      std::string("\x7f\xff\xff\xff"),
                                      std::string(8, '\xFF'),
                                      "OFFSETS",
                                      "_"};

std::vector<std::pair<std::string, std::string>> goodFiles() {
  std::vector<std::pair<std::string, std::string>> files{
      {"blender.bobj", bobj(true)},
      {"flip.bobj", bobj(false)},
      {"packed.bobj.gz", gzipped(bobj(true))},
      {"run.bgeo", bgeo({true, true, true, 3})},
      {"single.bgeo", bgeo({false})},
      {"text.vtk", vtk()},
      {"grid.vtk", vtk({false, true, true, true, true, true})},
      {"binary.vtk", vtk({true, false, false, false, true, true})},
      {"new.vtk", vtk({true, true, true, true})},
      {"properties.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
       "z\nproperty float vx\nproperty float "
       "vy\nproperty int vz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 2 "
       "3\n1 0 0 4 5 6\n0 1 0 7 8 9\n3 0 1 2\n"}};
  for (const auto format :
       {VtpOptions::ascii, VtpOptions::inlined, VtpOptions::appendedRaw, VtpOptions::appendedBase64})
    for (const bool packed : {false, true})
      files.emplace_back("arrays.vtp",
                         vtp({format, packed, packed, format == VtpOptions::inlined, packed, !packed}));
  return files;
}

// Whether it is read; if not, it is refused with a sentence.
bool isRead(const std::string& name, const std::string& bytes) {
  try {
    const Geometry geometry = geometryOf(name, bytes);
    for (const openvdb::Vec3I& triangle : geometry.triangles)
      for (int c = 0; c < 3; ++c) REQUIRE(triangle[c] < geometry.points.size());
    for (const auto& [attribute, values] : geometry.attributes)
      REQUIRE(values.values.size() == geometry.points.size() * std::size_t(values.components));
    return true;
  } catch (const FormatError& error) {
    const std::string sentence = error.what();
    REQUIRE(sentence.starts_with(name + ": "));
    REQUIRE(sentence.size() < 400);
    REQUIRE(sentence.find('\n') == std::string::npos);
    return false;
  }
}

void readMutated(int count) {
  double longest = 0.0;
  for (const auto& [name, bytes] : goodFiles()) {
    int good = 0;
    for (int n = 0; n < count; ++n) {
      CAPTURE(name, n);
      const auto start = std::chrono::steady_clock::now();
      good += isRead(name, mutated(bytes, std::uint64_t(n), kWords));
      longest =
          std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    CAPTURE(name);
    CHECK(good < count);
  }
  CHECK(longest < 5.0);
}

}  // namespace

TEST_CASE("damaged files: cut at any byte, they are read or refused", "[caches]") {
  for (const auto& [name, bytes] : goodFiles()) {
    REQUIRE(isRead(name, bytes));
    for (std::size_t length = 0; length<bytes.size(); length += bytes.size()> 1000 ? 7 : 1) {
      CAPTURE(name, length);
      const bool read = isRead(name, bytes.substr(0, length));
      // Of one kind all is needed; of the other the points alone are a file too.
      if (name == "packed.bobj.gz") CHECK_FALSE(read);
      if (name == "blender.bobj") CHECK(read == (length == 4 + 5 * 12));
    }
  }
}

TEST_CASE("damaged files: a bit or a byte that is another one", "[caches]") {
  for (const auto& [name, bytes] : goodFiles()) {
    for (std::size_t at = 0; at<bytes.size(); at += bytes.size()> 1000 ? 11 : 3) {
      for (const int change : {0x01, 0x80, 0xff}) {
        CAPTURE(name, at, change);
        std::string bad = bytes;
        bad[at] = static_cast<char>(bad[at] ^ change);
        isRead(name, bad);
      }
    }
  }
}

TEST_CASE("damaged files: mutated ones are read or refused, at once", "[caches]") {
  readMutated(300);
}

TEST_CASE("damaged files: many of them", "[caches][long]") {
  readMutated(10000);
}
