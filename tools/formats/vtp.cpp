#include "tools/formats/vtp.h"

#include "texture/exemplar/srgb.h"
#include "tools/formats/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <ostream>
#include <string_view>

namespace fluidtex::tools {
namespace {

static_assert(std::endian::native == std::endian::little, "VTP bytes are written as they lie in memory");

// The raw data behind the text: each array with its size in front. Refers to the arrays.
struct Appended {
  std::vector<std::string_view> arrays;
  std::uint64_t bytes = 0;

  // Appends an array and returns the element that tells of it.
  template <typename T>
  std::string add(const char* type, const std::string& name, int components, const std::vector<T>& values) {
    std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        type, name, components, bytes);
    arrays.emplace_back(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    bytes += sizeof(std::uint64_t) + arrays.back().size();
    return element;
  }

  void write(std::ostream& out) const {
    for (const std::string_view array : arrays) {
      const std::uint64_t size = array.size();
      out.write(reinterpret_cast<const char*>(&size), sizeof size);
      out.write(array.data(), static_cast<std::streamsize>(size));
    }
  }
};

std::vector<std::uint8_t> encodedBytes(const std::vector<texture::Vec4f>& color) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * color.size());
  for (const texture::Vec4f& c : color)
    for (int k = 0; k < 4; ++k) {
      const float value = k < 3 ? texture::encodeSrgb(c[k]) : c[k];
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f))));
    }
  return bytes;
}

}  // namespace

void writeVtp(const ExportMesh& mesh, std::ostream& out) {
  Appended data;
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n";
  text += fmt::format(
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
      "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" "
      "NumberOfPolys=\"{}\">\n",
      mesh.time, mesh.positions.size(), mesh.triangles.size());
  text += "<Points>\n" + data.add("Float32", "Points", 3, mesh.positions) + "</Points>\n";
  std::vector<std::int32_t> ends(mesh.triangles.size());
  for (std::size_t t = 0; t < ends.size(); ++t) ends[t] = std::int32_t(3 * (t + 1));
  // One by one: each adds its bytes.
  text += "<Polys>\n" + data.add("UInt32", "connectivity", 1, mesh.triangles);
  text += data.add("Int32", "offsets", 1, ends) + "</Polys>\n";
  const bool pictured = findColumn(mesh.vertex, "st") != nullptr;
  text += fmt::format("<PointData Scalars=\"color\" Normals=\"normal\" Vectors=\"velocity\"{}>\n",
                      pictured ? " TCoords=\"st\"" : "");
  const std::vector<std::uint8_t> colors = encodedBytes(mesh.color);
  text += data.add("Float32", "normal", 3, mesh.normals);
  text += data.add("UInt8", "color", 4, colors);
  std::deque<std::vector<float>> turned;
  for (const Column& column : mesh.vertex) {
    const std::vector<float>* values = &column.values;
    if (isUvSet(column.name)) {
      std::vector<float>& st = turned.emplace_back(*values);
      for (std::size_t i = 1; i < st.size(); i += 2) st[i] = 1.0f - st[i];
      values = &st;
    }
    text += data.add("Float32", column.name, column.components, *values);
  }
  text += "</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  out << text;
  data.write(out);
  out << "\n</AppendedData>\n</VTKFile>\n";
}

std::string pvdOf(const std::vector<int>& frames, double frameRate) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const int frame : frames)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", (frame - 1) / frameRate,
                        frameFile(Format::vtp, frame));
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace fluidtex::tools
