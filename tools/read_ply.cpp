#include "texture/map_names.h"
#include "texture/srgb.h"
#include "tools/errors.h"
#include "tools/ply.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace fluidtex::tools {
namespace {

using texture::Vec2f;
using texture::Vec3f;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw UsageError(file.string() + ": " + what + "; give a surface that fluidtex run has written");
}

// What a file says of itself up to the first vertex's byte.
struct Header {
  std::size_t vertices = 0, faces = 0, body = 0, stride = 0;
  std::map<std::string, std::size_t> offset;  // of each property in a vertex
};

Header headerOf(const std::string& bytes, const std::filesystem::path& file) {
  constexpr std::string_view kEnd = "end_header\n";
  Header header;
  const std::size_t end = bytes.find(kEnd);
  if (!bytes.starts_with("ply\n") || end == bytes.npos) refuse(file, "is no PLY file");
  header.body = end + kEnd.size();
  std::istringstream lines(bytes.substr(0, end));
  bool binary = false, inVertex = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "format") binary = second == "binary_little_endian";
    if (first == "element") {
      inVertex = second == "vertex";
      (inVertex ? header.vertices : header.faces) = std::strtoull(third.c_str(), nullptr, 10);
    }
    if (first != "property" || !inVertex) continue;
    if (second != "float" && second != "uchar") refuse(file, "has a property of type " + second);
    header.offset[third] = header.stride;
    header.stride += second == "float" ? 4 : 1;
  }
  if (!binary) refuse(file, "is not in the format binary_little_endian");
  for (const char* name :
       {"x", "nx", "red", "alpha", "s", "t", "dx", "bx", "vx", "trust", "age", "contact", "fade_s", "fade"})
    if (!header.offset.contains(name)) refuse(file, std::string("has no property ") + name);
  constexpr std::size_t kFace = 1 + 3 * 4;
  const std::size_t body = bytes.size() - header.body;
  if (header.vertices > body / header.stride || header.faces > body / kFace ||
      body != header.vertices * header.stride + header.faces * kFace)
    refuse(file, "is not as long as its header says");
  return header;
}

}  // namespace

texture::TexturedSurface readPly(const std::filesystem::path& file, int exemplarWidth, int exemplarHeight) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, "cannot be read");
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const Header header = headerOf(bytes, file);
  texture::TexturedSurface surface;
  surface.exemplarWidth = exemplarWidth;
  surface.exemplarHeight = exemplarHeight;
  const auto each = [&](const char* name, auto& values, auto read) {
    const char* at = bytes.data() + header.body + header.offset.at(name);
    values.resize(header.vertices);
    for (auto& value : values) {
      value = read(at);
      at += header.stride;
    }
  };
  const auto number = [](const char* at) {
    float value;
    std::memcpy(&value, at, sizeof value);
    return value;
  };
  const auto vector = [&](const char* at) { return Vec3f(number(at), number(at + 4), number(at + 8)); };
  const auto byte = [](const char* at) { return static_cast<std::uint8_t>(*at); };
  each("x", surface.positions, vector);
  each("nx", surface.normals, vector);
  each("dx", surface.orientation, vector);
  each("bx", surface.previousPosition, vector);
  each("vx", surface.velocity, vector);
  each("trust", surface.trust, number);
  each("age", surface.age, number);
  each("contact", surface.contact, byte);
  each("red", surface.color, [&](const char* at) {
    const auto share = [&](int c) { return float(byte(at + c)) / 255.0f; };
    return texture::Vec4f(texture::decodeSrgb(share(0)), texture::decodeSrgb(share(1)),
                          texture::decodeSrgb(share(2)), share(3));
  });
  const auto texel = [&](const char* at) {
    return Vec2f(number(at) * float(exemplarWidth) - 0.5f, number(at + 4) * float(exemplarHeight) - 0.5f);
  };
  each("s", surface.coordinate, texel);
  surface.fading = texture::noFading(header.vertices);
  each("fade_s", surface.fading.coordinate, texel);
  each("fade", surface.fading.weight, number);
  if (header.offset.contains("scale")) each("scale", surface.scale, number);
  for (const auto& [name, offset] : header.offset)
    if (!texture::isVertexProperty(name)) each(name.c_str(), surface.maps[name], number);
  surface.gradient.resize(header.vertices);
  const char* at = bytes.data() + header.body + header.vertices * header.stride;
  for (std::size_t f = 0; f < header.faces; ++f, at += 13) {
    std::int32_t corner[3];
    std::memcpy(corner, at + 1, sizeof corner);
    for (const std::int32_t c : corner)
      if (*at != 3 || c < 0 || std::size_t(c) >= header.vertices)
        refuse(file, "has a face that is no triangle of its vertices");
    surface.triangles.emplace_back(corner[0], corner[1], corner[2]);
  }
  return surface;
}

}  // namespace fluidtex::tools
