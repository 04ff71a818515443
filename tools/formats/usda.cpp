#include "tools/formats/usda.h"

#include "tools/formats/format.h"
#include "tools/formats/text_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace fluidtex::tools {
namespace {

// "[(0, 1), (2, 3)]": rows of `components` numbers each.
template <typename T>
void putRows(TextStream& text, const T* values, std::size_t rows, int components) {
  text.add("[");
  for (std::size_t row = 0; row < rows; ++row) {
    if (row > 0) text.add(", ");
    if (components > 1) text.add("(");
    for (int c = 0; c < components; ++c, ++values) {
      if (c > 0) text.add(", ");
      text.put("{}", *values);
    }
    if (components > 1) text.add(")");
  }
  text.add("]");
}

// Attributes of the mesh, each with one sample at the frame's time code. Value clips take time samples only.
struct Attributes {
  TextStream& text;
  int frame;

  template <typename T>
  void add(std::string_view type, std::string_view name, std::string_view interpolation, const T* values,
           std::size_t rows, int components) {
    if (!interpolation.empty())
      text.put("        {} {} (\n            interpolation = \"{}\"\n        )\n", type, name, interpolation);
    text.put("        {} {}.timeSamples = {{\n            {}: ", type, name, frame);
    putRows(text, values, rows, components);
    text.put(",\n        }}\n");
  }
  void addVectors(std::string_view type, std::string_view name, std::string_view interpolation,
                  const std::vector<texture::Vec3f>& values) {
    add(type, name, interpolation, reinterpret_cast<const float*>(values.data()), values.size(), 3);
  }
  void addPrimvar(const Column& column, std::string_view interpolation) {
    static const char* const kTypes[] = {"float[]", "float2[]", "float3[]", "float4[]"};
    add(kTypes[column.components - 1], "primvars:" + column.name, interpolation, column.values.data(),
        column.values.size() / std::size_t(column.components), column.components);
  }
  // rows: which of the column's there are; index: which of these each corner has.
  void addUvSet(const Column& column, const std::vector<std::uint32_t>& rows, const std::uint32_t* index,
                std::size_t corners) {
    std::vector<float> values;
    values.reserve(2 * rows.size());
    for (const std::uint32_t row : rows) {
      values.push_back(column.values[2 * row]);
      values.push_back(1.0f - column.values[2 * row + 1]);  // origin lower left
    }
    const std::string name = "primvars:" + column.name;
    add("texCoord2f[]", name, "faceVarying", values.data(), rows.size(), 2);
    add("int[]", name + ":indices", "", index, corners, 1);
  }
};

void putExtent(Attributes& attributes, const std::vector<texture::Vec3f>& positions) {
  if (positions.empty()) return;
  std::vector<texture::Vec3f> extent{positions[0], positions[0]};
  for (const texture::Vec3f& x : positions) {
    extent[0] = openvdb::math::minComponent(extent[0], x);
    extent[1] = openvdb::math::maxComponent(extent[1], x);
  }
  attributes.addVectors("float3[]", "extent", "", extent);
}

void putColors(Attributes& attributes, const std::vector<texture::Vec4f>& color) {
  std::vector<texture::Vec3f> rgb;
  std::vector<float> opacity;
  for (const texture::Vec4f& c : color) {
    rgb.emplace_back(c[0], c[1], c[2]);
    opacity.push_back(c[3]);
  }
  attributes.addVectors("color3f[]", "primvars:displayColor", "vertex", rgb);
  if (std::any_of(opacity.begin(), opacity.end(), [](float a) { return a < 1.0f; }))
    attributes.add("float[]", "primvars:displayOpacity", "vertex", opacity.data(), opacity.size(), 1);
}

void putMesh(TextStream& text, const ExportMesh& mesh, bool pictured) {
  if (pictured)
    text.put(
        "    def Mesh \"surface\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n    )\n    {{\n"
        "        rel material:binding = </liquid/material>\n");
  else
    text.put("    def Mesh \"surface\"\n    {{\n");
  text.put("        uniform token subdivisionScheme = \"none\"\n");
  Attributes attributes{text, mesh.frame};
  putExtent(attributes, mesh.positions);
  const auto* corners = reinterpret_cast<const std::uint32_t*>(mesh.triangles.data());
  const std::size_t cornerCount = 3 * mesh.triangles.size();
  const std::vector<int> three(mesh.triangles.size(), 3);
  attributes.add("int[]", "faceVertexCounts", "", three.data(), three.size(), 1);
  attributes.add("int[]", "faceVertexIndices", "", corners, cornerCount, 1);
  attributes.addVectors("point3f[]", "points", "", mesh.positions);
  attributes.addVectors("normal3f[]", "normals", "vertex", mesh.normals);
  putColors(attributes, mesh.color);
  std::vector<std::uint32_t> every(mesh.positions.size());
  for (std::uint32_t v = 0; v < every.size(); ++v) every[v] = v;
  for (const Column& column : mesh.vertex) {
    if (column.name == "velocity")
      attributes.add("vector3f[]", "velocities", "", column.values.data(), column.values.size() / 3, 3);
    else if (isUvSet(column.name))
      attributes.addUvSet(column, every, corners, cornerCount);
    else
      attributes.addPrimvar(column, "vertex");
  }
  for (const Column& column : mesh.corner) {
    if (isUvSet(column.name)) {
      const IndexedColumn rows = indexed(mesh, {&column});
      attributes.addUvSet(column, rows.first, rows.index.data(), cornerCount);
    } else {
      attributes.addPrimvar(column, "faceVarying");
    }
  }
  text.put("    }}\n");
}

void putMaterial(TextStream& text, const Appearance& appearance, int frame) {
  const char* wrap = appearance.toroidal ? "repeat" : "clamp";
  text.put(
      "\n    def Material \"material\"\n    {{\n"
      "        token outputs:surface.connect = </liquid/material/preview.outputs:surface>\n\n"
      "        def Shader \"preview\"\n        {{\n"
      "            uniform token info:id = \"UsdPreviewSurface\"\n"
      "            color3f inputs:diffuseColor.connect = </liquid/material/picture.outputs:rgb>\n"
      "            float inputs:roughness = 1\n            float inputs:clearcoat = {:g}\n"
      "            float inputs:clearcoatRoughness = {:.4g}\n",
      appearance.gloss, std::sqrt(appearance.roughness));
  if (appearance.seeThrough)
    text.put("            float inputs:opacity.connect = </liquid/material/picture.outputs:a>\n");
  text.put(
      "            token outputs:surface\n        }}\n\n"
      "        def Shader \"picture\"\n        {{\n"
      "            uniform token info:id = \"UsdUVTexture\"\n"
      "            asset inputs:file = @../{}@\n{}            token inputs:sourceColorSpace = \"sRGB\"\n"
      "            float2 inputs:st.connect = </liquid/material/st.outputs:result>\n"
      "            token inputs:wrapS = \"{}\"\n            token inputs:wrapT = \"{}\"\n"
      "            float outputs:a\n            float3 outputs:rgb\n        }}\n\n"
      "        def Shader \"st\"\n        {{\n"
      "            uniform token info:id = \"UsdPrimvarReader_float2\"\n"
      "            string inputs:varname = \"st\"\n            float2 outputs:result\n        }}\n    }}\n",
      appearance.picture,
      // A stage takes values that change from the frames' files by their times.
      appearance.moves ? fmt::format("            asset inputs:file.timeSamples = {{ {}: @../{}@ }}\n", frame,
                                     appearance.picture)
                       : "",
      wrap, wrap);
}

void putHead(TextStream& text, int first, int last, double frameRate) {
  text.put(
      "#usda 1.0\n(\n    defaultPrim = \"liquid\"\n    endTimeCode = {}\n    framesPerSecond = {}\n"
      "    metersPerUnit = 1\n    startTimeCode = {}\n    timeCodesPerSecond = {}\n    upAxis = "
      "\"Z\"\n)\n\n",
      last, frameRate, first, frameRate);
}

}  // namespace

void writeUsda(const ExportMesh& mesh, const Appearance& appearance, std::ostream& out) {
  TextStream text(out);
  putHead(text, mesh.frame, mesh.frame, appearance.frameRate);
  text.put("def Xform \"liquid\"\n{{\n");
  const bool blends = findColumn(mesh.corner, "joint") != nullptr;
  const bool pictured = !appearance.picture.empty() && !blends;
  putMesh(text, mesh, pictured);
  if (pictured) putMaterial(text, appearance, mesh.frame);
  text.put("}}\n");
}

void writeUsdStage(const std::vector<int>& frames, int fullest, double frameRate, std::ostream& out) {
  TextStream text(out);
  putHead(text, frames.front(), frames.back(), frameRate);
  const std::string model = frameFile(Format::usda, fullest);
  std::string active, paths, times;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const char* comma = n > 0 ? ", " : "";
    active += fmt::format("{}({}, {})", comma, frames[n], n);
    paths += fmt::format("{}@./{}@", comma, frameFile(Format::usda, frames[n]));
    times += fmt::format("{}({}, {})", comma, frames[n], frames[n]);
  }
  text.put(
      "def Xform \"liquid\" (\n    prepend references = @./{}@</liquid>\n    clips = {{\n"
      "        dictionary default = {{\n            double2[] active = [{}]\n"
      "            asset[] assetPaths = [{}]\n            asset manifestAssetPath = @./{}@\n"
      "            string primPath = \"/liquid\"\n            double2[] times = [{}]\n        }}\n    }}\n)\n"
      "{{\n}}\n",
      model, active, paths, model, times);
}

}  // namespace fluidtex::tools
