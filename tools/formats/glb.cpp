#include "tools/formats/glb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string_view>

namespace fluidtex::tools {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF bytes are written as they lie in memory");

enum ComponentType { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };
enum Target { kVertices = 34962, kIndices = 34963 };
constexpr std::size_t kVersion = 2, kChunkHead = 8, kFileHead = 12;

const char* typeOf(int components) {
  static const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kTypes[components - 1];
}

// What the buffer is made of. Refers to the arrays.
struct Buffer {
  std::vector<std::string_view> arrays;
  std::size_t bytes = 0;
  Json views = Json::array(), accessors = Json::array();

  // Returns the accessor's number. All types here have a multiple of four bytes, so everything is aligned.
  int add(const void* values, std::size_t size, std::size_t count, const char* type, ComponentType component,
          Target target) {
    views.push_back({{"buffer", 0}, {"byteOffset", bytes}, {"byteLength", size}, {"target", target}});
    arrays.emplace_back(static_cast<const char*>(values), size);
    bytes += size;
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    return int(accessors.size()) - 1;
  }
  template <typename T>
  int addFloats(const std::vector<T>& values, int components) {
    const std::size_t size = values.size() * sizeof(T);
    return add(values.data(), size, size / sizeof(float) / std::size_t(components), typeOf(components),
               kFloat, kVertices);
  }
};

// Required of positions.
void setRange(Json& accessor, const std::vector<texture::Vec3f>& values) {
  texture::Vec3f low = values[0], high = values[0];
  for (const texture::Vec3f& x : values) {
    low = openvdb::math::minComponent(low, x);
    high = openvdb::math::maxComponent(high, x);
  }
  accessor["min"] = Json::array({low[0], low[1], low[2]});
  accessor["max"] = Json::array({high[0], high[1], high[2]});
}

// Sixteen bits: eight of linear light are too few in the dark.
std::vector<std::uint16_t> encoded(const std::vector<texture::Vec4f>& color) {
  std::vector<std::uint16_t> values;
  values.reserve(4 * color.size());
  for (const texture::Vec4f& c : color)
    for (int k = 0; k < 4; ++k)
      values.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * std::clamp(c[k], 0.0f, 1.0f))));
  return values;
}

// In capitals; of names that differ in these alone, the first. The others stay as they are, with a _ behind
// them where that is not enough.
std::string customName(const std::string& name, const Json& taken) {
  std::string capitals = "_" + name;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  if (!taken.contains(capitals)) return capitals;
  std::string own = "_" + name;
  while (taken.contains(own)) own += "_";
  return own;
}

Json attributesOf(const ExportMesh& mesh, const std::vector<std::uint16_t>& colors, bool pictured,
                  Buffer& buffer) {
  Json attributes;
  attributes["POSITION"] = buffer.addFloats(mesh.positions, 3);
  setRange(buffer.accessors.back(), mesh.positions);
  attributes["NORMAL"] = buffer.addFloats(mesh.normals, 3);
  attributes[pictured ? "_COLOR" : "COLOR_0"] =
      buffer.add(colors.data(), colors.size() * sizeof(std::uint16_t), mesh.color.size(), "VEC4",
                 kUnsignedShort, kVertices);
  buffer.accessors.back()["normalized"] = true;
  int sets = 0;
  for (const char* name : kUvSets)
    if (const Column* column = findColumn(mesh.vertex, name))
      attributes["TEXCOORD_" + std::to_string(sets++)] = buffer.addFloats(column->values, 2);
  for (const Column& column : mesh.vertex)
    if (!isUvSet(column.name))
      attributes[customName(column.name, attributes)] = buffer.addFloats(column.values, column.components);
  return attributes;
}

Json materialOf(const Appearance& appearance, bool pictured) {
  Json surface = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
  if (pictured) surface["baseColorTexture"] = {{"index", 0}, {"texCoord", 0}};
  Json material = {{"name", "exemplar"}, {"pbrMetallicRoughness", std::move(surface)}};
  // glTF's roughness is the root of alpha.
  material["extensions"]["KHR_materials_clearcoat"] = {
      {"clearcoatFactor", appearance.gloss}, {"clearcoatRoughnessFactor", std::sqrt(appearance.roughness)}};
  if (appearance.seeThrough) material["alphaMode"] = "BLEND";
  return material;
}

// A number, little endian.
void put(std::ostream& out, std::size_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  out.write(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

void writeGlb(const ExportMesh& whole, const Appearance& appearance, std::ostream& out) {
  Json gltf = {{"asset", {{"version", "2.0"}, {"generator", "fluidtex"}}}, {"scene", 0}};
  gltf["scenes"] = Json::array(
      {{{"nodes", Json::array({0})}, {"extras", {{"frame", whole.frame}, {"time", whole.time}}}}});
  // A quarter turn about x: (x, y, z) of Z up is (x, z, -y) of Y up.
  const double half = std::sqrt(0.5);
  Json node = {{"name", appearance.name}, {"rotation", Json::array({-half, 0.0, 0.0, half})}};
  Buffer buffer;
  ExportMesh split;
  std::vector<std::uint16_t> colors;
  if (!whole.triangles.empty()) {
    if (!whole.corner.empty()) split = splitAtCorners(whole);
    const ExportMesh& mesh = whole.corner.empty() ? whole : split;
    colors = encoded(mesh.color);
    const bool pictured = !appearance.picture.empty() && !findColumn(mesh.vertex, "joint");
    Json primitive = {{"attributes", attributesOf(mesh, colors, pictured, buffer)}};
    primitive["indices"] = buffer.add(mesh.triangles.data(), mesh.triangles.size() * sizeof(texture::Vec3I),
                                      3 * mesh.triangles.size(), "SCALAR", kUnsignedInt, kIndices);
    primitive["material"] = 0;
    node["mesh"] = 0;
    gltf["meshes"] =
        Json::array({{{"name", appearance.name}, {"primitives", Json::array({std::move(primitive)})}}});
    gltf["materials"] = Json::array({materialOf(appearance, pictured)});
    gltf["extensionsUsed"] = Json::array({"KHR_materials_clearcoat"});
    if (pictured) {
      const int wrap = appearance.toroidal ? 10497 : 33071;  // REPEAT, CLAMP_TO_EDGE
      constexpr int kLinear = 9729, kMipmapped = 9987;
      gltf["samplers"] = Json::array(
          {{{"magFilter", kLinear}, {"minFilter", kMipmapped}, {"wrapS", wrap}, {"wrapT", wrap}}});
      gltf["images"] = Json::array({{{"uri", "../" + appearance.picture}}});
      gltf["textures"] = Json::array({{{"sampler", 0}, {"source", 0}}});
    }
    gltf["bufferViews"] = std::move(buffer.views);
    gltf["accessors"] = std::move(buffer.accessors);
    gltf["buffers"] = Json::array({{{"byteLength", buffer.bytes}}});
  }
  gltf["nodes"] = Json::array({std::move(node)});
  std::string text = gltf.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const bool hasBuffer = buffer.bytes > 0;
  const std::size_t size = kFileHead + kChunkHead + text.size() + (hasBuffer ? kChunkHead + buffer.bytes : 0);
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error(
        "glb: a file holds 4 GB at most; give another --format, or fewer texture.points");
  out.write("glTF", 4);
  put(out, kVersion);
  put(out, size);
  put(out, text.size());
  out.write("JSON", 4);
  out << text;
  if (!hasBuffer) return;
  put(out, buffer.bytes);
  out.write("BIN", 4);  // and a zero
  for (const std::string_view array : buffer.arrays)
    out.write(array.data(), static_cast<std::streamsize>(array.size()));
}

}  // namespace fluidtex::tools
