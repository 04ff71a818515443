#include "tools/formats/glb.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>

namespace fluidtex::tools {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF bytes are written as they lie in memory");

enum ComponentType { kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126 };
enum Target { kVertices = 34962, kIndices = 34963 };
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::size_t kChunkHead = 8, kFileHead = 12;

const char* typeOf(int components) {
  static const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kTypes[components - 1];
}

// Fills the buffer, and lists what is in it.
struct Buffer {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();

  // Returns the accessor's number. All types here have a multiple of four bytes, so everything is aligned.
  int add(const void* values, std::size_t size, std::size_t count, const char* type, ComponentType component,
          Target target) {
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", size}, {"target", target}});
    bytes.append(static_cast<const char*>(values), size);
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
int addColor(Buffer& buffer, const std::vector<texture::Vec4f>& color) {
  std::vector<std::uint16_t> values;
  values.reserve(4 * color.size());
  for (const texture::Vec4f& c : color)
    for (int k = 0; k < 4; ++k)
      values.push_back(static_cast<std::uint16_t>(std::lround(65535.0f * std::clamp(c[k], 0.0f, 1.0f))));
  const int accessor = buffer.add(values.data(), values.size() * sizeof(std::uint16_t), color.size(), "VEC4",
                                  kUnsignedShort, kVertices);
  buffer.accessors[std::size_t(accessor)]["normalized"] = true;
  return accessor;
}

std::string customName(const std::string& name, const Json& taken) {
  std::string capitals = "_" + name;
  std::transform(capitals.begin(), capitals.end(), capitals.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  return taken.contains(capitals) ? "_" + name : capitals;
}

Json attributesOf(const ExportMesh& mesh, bool pictured, Buffer& buffer) {
  Json attributes;
  attributes["POSITION"] = buffer.addFloats(mesh.positions, 3);
  setRange(buffer.accessors.back(), mesh.positions);
  attributes["NORMAL"] = buffer.addFloats(mesh.normals, 3);
  attributes[pictured ? "_COLOR" : "COLOR_0"] = addColor(buffer, mesh.color);
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
void append(std::string& bytes, std::uint32_t value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

void appendChunk(std::string& bytes, std::uint32_t type, std::string content, char filler) {
  content.resize((content.size() + 3) / 4 * 4, filler);
  append(bytes, std::uint32_t(content.size()));
  append(bytes, type);
  bytes += content;
}

}  // namespace

std::string glbOf(const ExportMesh& whole, const Appearance& appearance) {
  Json gltf = {{"asset", {{"version", "2.0"}, {"generator", "fluidtex"}}}, {"scene", 0}};
  gltf["scenes"] = Json::array(
      {{{"nodes", Json::array({0})}, {"extras", {{"frame", whole.frame}, {"time", whole.time}}}}});
  // A quarter turn about x: (x, y, z) of Z up is (x, z, -y) of Y up.
  const double half = std::sqrt(0.5);
  Json node = {{"name", appearance.name}, {"rotation", Json::array({-half, 0.0, 0.0, half})}};
  Buffer buffer;
  if (!whole.triangles.empty()) {
    const ExportMesh mesh = splitAtCorners(whole);
    const bool pictured = !appearance.picture.empty() && !findColumn(mesh.vertex, "joint");
    Json primitive = {{"attributes", attributesOf(mesh, pictured, buffer)}};
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
    gltf["buffers"] = Json::array({{{"byteLength", buffer.bytes.size()}}});
  }
  gltf["nodes"] = Json::array({std::move(node)});
  std::string chunks;
  appendChunk(chunks, kJsonChunk, gltf.dump(), ' ');
  if (!buffer.bytes.empty()) appendChunk(chunks, kBinaryChunk, std::move(buffer.bytes), '\0');
  std::string file;
  append(file, kMagic);
  append(file, kVersion);
  append(file, std::uint32_t(kFileHead + chunks.size()));
  return file + chunks;
}

}  // namespace fluidtex::tools
