#include "tools/formats/read_ply.h"
#include "texture/exemplar/srgb.h"
#include "texture/map_names.h"
#include "tools/base/errors.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

namespace fluidtex::tools {
namespace {

using texture::Vec2f;
using texture::Vec3f;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw UsageError(file.string() + ": " + what + "; give a surface that fluidtex run has written");
}

struct Property {
  std::size_t offset = 0;  // in a vertex
  bool isFloat = false;    // else a byte
};

// What a file says of itself up to the first vertex's byte.
struct Header {
  std::size_t vertices = 0, faces = 0, joints = 0, body = 0, stride = 0;
  bool gradients = false;
  std::map<std::string, Property, std::less<>> property;
};

// What readPly() takes at once: properties of one type, one behind the other.
struct Group {
  bool isFloat;
  std::vector<std::string_view> names;
};
const std::vector<Group> kGroups = {{true, {"x", "y", "z"}},
                                    {true, {"nx", "ny", "nz"}},
                                    {false, {"red", "green", "blue", "alpha"}},
                                    {true, {"s", "t"}},
                                    {true, {"dx", "dy", "dz"}},
                                    {true, {"bx", "by", "bz"}},
                                    {true, {"vx", "vy", "vz"}},
                                    {true, {"trust"}},
                                    {true, {"age"}},
                                    {false, {"contact"}},
                                    {true, {"fade_s", "fade_t"}},
                                    {true, {"fade"}}};
// What files of earlier versions do not have.
const std::vector<Group> kGradients = {
    {true, {"sx", "sy", "sz", "tx", "ty", "tz"}},
    {true, {"fade_sx", "fade_sy", "fade_sz", "fade_tx", "fade_ty", "fade_tz"}}};

void checkGroup(const Group& group, const Header& header, const std::filesystem::path& file) {
  std::size_t next = 0;
  for (const std::string_view name : group.names) {
    const auto found = header.property.find(name);
    if (found == header.property.end()) refuse(file, "has no property " + std::string(name));
    const auto [offset, isFloat] = found->second;
    if (isFloat != group.isFloat)
      refuse(file,
             "has a property " + std::string(name) + " that is no " + (group.isFloat ? "float" : "uchar"));
    if (name != group.names.front() && offset != next)
      refuse(file, "has a property " + std::string(name) + " that does not follow the one before");
    next = offset + (isFloat ? sizeof(float) : 1);
  }
}

// A name that a scene can give to a map.
bool isMapName(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

Header headerOf(const std::string& bytes, const std::filesystem::path& file) {
  constexpr std::string_view kEnd = "end_header\n";
  Header header;
  const std::size_t end = bytes.find(kEnd);
  if (!bytes.starts_with("ply\n") || end == bytes.npos) refuse(file, "is no PLY file");
  header.body = end + kEnd.size();
  std::istringstream lines(bytes.substr(0, end));
  bool binary = false;
  std::string element;
  std::size_t jointBytes = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "format") binary = second == "binary_little_endian";
    if (first == "element") {
      element = second;
      (second == "vertex"  ? header.vertices
       : second == "joint" ? header.joints
                           : header.faces) = std::strtoull(third.c_str(), nullptr, 10);
    }
    if (first == "property" && element == "joint") jointBytes += 4;  // of numbers and coordinates
    if (first != "property" || element != "vertex") continue;
    if (second != "float" && second != "uchar")
      refuse(file, "has a property of a vertex that is neither float nor uchar");
    const bool isFloat = second == "float";
    if (!texture::isReservedName(third)) {
      if (!isMapName(third)) refuse(file, "has a property whose name is no map's");
      if (!isFloat) refuse(file, "has a property " + third + " that is no float");
    }
    header.property[third] = {header.stride, isFloat};
    header.stride += isFloat ? sizeof(float) : 1;
  }
  if (!binary) refuse(file, "is not in the format binary_little_endian");
  for (const Group& group : kGroups) checkGroup(group, header, file);
  header.gradients = header.property.contains("fade_sx");
  if (header.gradients)
    for (const Group& group : kGradients) checkGroup(group, header, file);
  for (const char* name : {"scale", "guidance", "foam"})
    if (header.property.contains(name)) checkGroup({true, {name}}, header, file);
  constexpr std::size_t kFace = 1 + 3 * 4;
  const std::size_t body = bytes.size() - header.body;
  if (header.vertices > body / header.stride || header.faces > body / kFace || header.joints > body ||
      body != header.vertices * header.stride + header.faces * kFace + header.joints * jointBytes)
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
  const auto each = [&](std::string_view name, auto& values, auto read) {
    const char* at = bytes.data() + header.body + header.property.find(name)->second.offset;
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
    const float s = number(at), t = number(at + 4);
    if (!(s >= 0.0f && s <= 1.0f && t >= 0.0f && t <= 1.0f))  // nor is what is no number
      refuse(file, "has a coordinate on the exemplar that is not from 0 to 1");
    return Vec2f(s * float(exemplarWidth) - 0.5f, t * float(exemplarHeight) - 0.5f);
  };
  each("s", surface.coordinate, texel);
  surface.fading = texture::noFading(header.vertices);
  each("fade_s", surface.fading.coordinate, texel);
  each("fade", surface.fading.weight, number);
  const auto optional = [&](const char* name, std::vector<float>& values) {
    if (header.property.contains(name)) each(name, values, number);
  };
  optional("scale", surface.scale);
  optional("guidance", surface.guidance);
  optional("foam", surface.foam);
  for (const auto& [name, property] : header.property)
    if (!texture::isReservedName(name)) each(name, surface.maps[name], number);
  surface.gradient.resize(header.vertices);
  if (header.gradients) {
    const Vec2f size{float(exemplarWidth), float(exemplarHeight)};
    const auto gradient = [&](const char* at) {
      return texture::TexelGradient{vector(at) * size[0], vector(at + 12) * size[1]};
    };
    each("sx", surface.gradient, gradient);
    each("fade_sx", surface.fading.gradient, gradient);
  }
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

bool lacksGradients(const texture::TexturedSurface& surface) {
  return std::all_of(surface.gradient.begin(), surface.gradient.end(), [](const texture::TexelGradient& g) {
    return g.s == Vec3f(0.0f) && g.t == Vec3f(0.0f);
  });
}

}  // namespace fluidtex::tools
