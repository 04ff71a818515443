#include "tools/formats/vtp.h"

#include "tests/tools/formats/sample_mesh.h"

#include <catch2/catch.hpp>

#include <cstring>
#include <regex>

using namespace fluidtex;

namespace {

std::string vtpOf(const tools::ExportMesh& mesh) {
  return written([&](std::ostream& out) { tools::writeVtp(mesh, out); });
}

// The raw bytes of an array by its name, by the offset and the size that the file gives.
std::string arrayOf(const std::string& file, const std::string& name) {
  std::smatch found;
  const std::string head = file.substr(0, file.find("<AppendedData"));
  REQUIRE(std::regex_search(head, found, std::regex("Name=\"" + name + "\"[^>]*offset=\"(\\d+)\"")));
  const std::size_t start = file.find('_', head.size()) + 1, offset = std::stoul(found[1]);
  std::uint64_t size = 0;
  REQUIRE(start + offset + sizeof size <= file.size());
  std::memcpy(&size, file.data() + start + offset, sizeof size);
  REQUIRE(start + offset + sizeof size + size <= file.size());
  return file.substr(start + offset + sizeof size, size);
}

template <typename T>
std::vector<T> valuesOf(const std::string& file, const std::string& name) {
  const std::string bytes = arrayOf(file, name);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

}  // namespace

TEST_CASE("vtp: every array lies where the file says", "[tools]") {
  const std::string file = vtpOf(sampleMesh());
  CHECK(file.find("NumberOfPoints=\"4\"") != std::string::npos);
  CHECK(file.find("NumberOfPolys=\"2\"") != std::string::npos);
  CHECK(file.find(">0.25</DataArray>") != std::string::npos);  // the time
  CHECK(valuesOf<float>(file, "Points") == std::vector<float>{0, 0, 2, 1, 0, 2, 1, 3, 2, 0, 3, 2});
  CHECK(valuesOf<std::uint32_t>(file, "connectivity") == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  CHECK(valuesOf<std::int32_t>(file, "offsets") == std::vector<std::int32_t>{3, 6});
  CHECK(valuesOf<float>(file, "age") == std::vector<float>{0.5f, 1.5f, 2.5f, 3.5f});
  const auto color = valuesOf<std::uint8_t>(file, "color");
  REQUIRE(color.size() == 16);
  CHECK(int(color[12]) == 188);  // sRGB of linear 0.5
  CHECK(int(color[15]) == 255);
  // The origin is the lower left corner.
  CHECK(valuesOf<float>(file, "st") ==
        std::vector<float>{0.25f, 0.875f, 1.25f, 0.875f, 1.25f, 0.25f, 0.25f, 0.25f});
}

TEST_CASE("vtp: a frame without surface is a file without points", "[tools]") {
  const std::string file = vtpOf({});
  CHECK(file.find("NumberOfPoints=\"0\"") != std::string::npos);
  CHECK(arrayOf(file, "Points").empty());
}

TEST_CASE("pvd: frames have their times and the names of their files", "[tools]") {
  const std::string text = tools::pvdOf({1, 25}, 24.0);
  CHECK(text.find("timestep=\"0\" part=\"0\" file=\"vtp/0001.vtp\"") != std::string::npos);
  CHECK(text.find("timestep=\"1\" part=\"0\" file=\"vtp/0025.vtp\"") != std::string::npos);
}
