// 3D Systems, "StereoLithography Interface Specification", 1989.
#include "sim/meshes/mesh_formats.h"
#include "sim/meshes/text_scan.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace fluidtex::sim {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers of a binary STL are little-endian");

constexpr std::size_t kHeader = 80, kFacet = 50;

// Binary headers may begin with "solid" too. Only a binary file has zero bytes, and one whose length is what
// its count says is one.
bool isText(std::string_view bytes) {
  if (bytes.size() >= kHeader + 4) {
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + kHeader, sizeof count);
    if (bytes.size() == kHeader + 4 + kFacet * count) return false;
  }
  std::string_view start = bytes;
  return inLowerCase(takeWord(start).substr(0, 5)) == "solid" && bytes.find('\0') == std::string_view::npos;
}

MeshSoup binarySoup(std::string_view bytes) {
  if (bytes.size() < kHeader + 4)
    throw std::runtime_error(
        "is no STL: it begins neither with 'solid' nor is it long enough to be a binary one");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader, sizeof count);
  const std::uint64_t needed = kHeader + 4 + kFacet * std::uint64_t(count);
  if (bytes.size() < needed)
    throw std::runtime_error("is cut short or no STL: as a binary one it would hold " +
                             std::to_string(count) + " facets in " + std::to_string(needed) +
                             " bytes, and it has " + std::to_string(bytes.size()));
  MeshSoup soup;
  soup.points.reserve(3 * std::size_t(count));
  soup.polygons.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    std::array<float, 9> corners;  // behind a normal, which counts nowhere
    std::memcpy(corners.data(), bytes.data() + kHeader + 4 + kFacet * n + 12, sizeof corners);
    for (int c = 0; c < 9; c += 3) soup.points.emplace_back(corners[c], corners[c + 1], corners[c + 2]);
    soup.polygons.push_back({3 * n, 3 * n + 1, 3 * n + 2});
  }
  return soup;
}

// By words and not by lines: some files have several keywords on a line.
MeshSoup textSoup(std::string_view text) {
  const std::string_view whole = text;
  const auto fail = [&](const std::string& what) {
    const std::string_view before = whole.substr(0, whole.size() - text.size());
    throw std::runtime_error("line " + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) +
                             ": " + what);
  };
  MeshSoup soup;
  std::size_t first = 0;  // of the points of the facet that is being read
  const auto close = [&] {
    const std::size_t corners = soup.points.size() - first;
    if (corners == 0) return;
    if (corners < 3) fail("a facet needs three vertices and has " + std::to_string(corners));
    std::vector<std::size_t>& polygon = soup.polygons.emplace_back();
    for (; first < soup.points.size(); ++first) polygon.push_back(first);
  };
  for (std::string_view word = takeWord(text); !word.empty(); word = takeWord(text)) {
    const std::string keyword = inLowerCase(word);
    if (keyword == "solid" || keyword == "endsolid") {
      takeLine(text);  // a name, of any words
    } else if (keyword == "endloop" || keyword == "endfacet") {
      close();
    } else if (keyword == "vertex") {
      Vec3d x;
      for (int a = 0; a < 3; ++a) {
        const std::string_view number = takeWord(text);
        if (!parseNumber(number, x[a]))
          fail(number.empty() ? "a vertex needs three numbers" : inQuotes(number) + " is not a number");
      }
      soup.points.push_back(x);
    }
  }
  if (first < soup.points.size()) fail("the file ends within a facet");
  return soup;
}

}  // namespace

MeshSoup soupOfStl(std::string_view bytes) {
  const std::string_view text = withoutMark(bytes);
  return isText(text) ? textSoup(text) : binarySoup(bytes);
}

}  // namespace fluidtex::sim
