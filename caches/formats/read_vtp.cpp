// Kitware, "VTK XML Formats". VTK itself is not linked: see read_vtk.cpp.
#include "caches/formats/build_geometry.h"
#include "caches/formats/geometry_formats.h"
#include "caches/formats/vtk_xml_arrays.h"
#include "sim/meshes/text_scan.h"

namespace fluidtex::caches {

namespace {

// The file's XML, which raw data in AppendedData is not: that is cut out and left in `appended`.
pugi::xml_document documentOf(std::string_view bytes, std::string_view& appended) {
  std::string xml(bytes);
  const std::size_t begin = bytes.find("<AppendedData");
  const std::size_t end = bytes.find('>', std::min(begin, bytes.size()));
  if (begin != std::string_view::npos) {
    const std::size_t mark = bytes.find('_', std::min(end, bytes.size()));
    if (mark == std::string_view::npos)
      throw std::runtime_error("its AppendedData does not begin with '_'; write or copy it anew");
    appended = bytes.substr(mark + 1);
    const bool isClosed = bytes[end - 1] == '/';
    xml = std::string(bytes.substr(0, end - isClosed)) + "/></VTKFile>";
  }
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(xml.data(), xml.size());
  if (!result) {
    const auto line =
        1 + std::count(xml.begin(), xml.begin() + std::min(result.offset, std::ptrdiff_t(xml.size())), '\n');
    throw std::runtime_error("line " + std::to_string(line) +
                             ": is not XML as VTK writes it: " + result.description());
  }
  return document;
}

XmlArrays arraysOf(const pugi::xml_node& root, std::string_view appended) {
  XmlArrays file;
  const std::string_view order = root.attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    throw std::runtime_error("has byte_order=" + sim::inQuotes(order) +
                             "; expected LittleEndian or BigEndian");
  file.order = order == "BigEndian" ? std::endian::big : std::endian::little;
  const std::string_view header = root.attribute("header_type").as_string("UInt32");
  if (header != "UInt32" && header != "UInt64")
    throw std::runtime_error("has header_type=" + sim::inQuotes(header) + "; expected UInt32 or UInt64");
  file.headerType = header == "UInt64" ? NumberType::uint64 : NumberType::uint32;
  const std::string_view compressor = root.attribute("compressor").value();
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    throw std::runtime_error("is packed by " + sim::inQuotes(compressor) +
                             "; write it with zlib (vtkZLibDataCompressor) or unpacked");
  file.isPacked = !compressor.empty();
  const pugi::xml_node data = root.child("AppendedData");
  const std::string_view encoding = data.attribute("encoding").as_string("base64");
  if (encoding != "base64" && encoding != "raw")
    throw std::runtime_error("its AppendedData is in encoding " + sim::inQuotes(encoding) +
                             "; expected raw or base64");
  file.appendedIsBase64 = encoding == "base64";
  file.appended = appended;
  return file;
}

template <class To>
std::vector<To> named(const pugi::xml_node& parent, const char* name, XmlArrays& file) {
  const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
  if (!array) throw std::runtime_error(std::string(parent.name()) + " has no array '" + name + "'");
  return numbersOf<To>(array, file);
}

void takeCells(const pugi::xml_node& piece, const char* name, const char* number, AddCell add,
               XmlArrays& file, Geometry& geometry) {
  const std::uint64_t count = piece.attribute(number) ? countOf(piece, number) : 0;
  if (count == 0) return;
  const pugi::xml_node cells = piece.child(name);
  const auto corners = named<std::int64_t>(cells, "connectivity", file);
  const auto ends = named<std::int64_t>(cells, "offsets", file);
  if (ends.size() != count)
    throw std::runtime_error("its " + std::string(name) + " have " + counted(ends.size(), "offset") +
                             ", but " + number + " is " + std::to_string(count));
  addCells(corners, ends, add, geometry);
}

Geometry geometryOf(const pugi::xml_node& piece, XmlArrays& file) {
  Geometry geometry;
  const std::uint64_t points = countOf(piece, "NumberOfPoints");
  if (points > 0) {
    const auto coordinates = numbersOf<float>(piece.child("Points").child("DataArray"), file);
    if (coordinates.size() % 3 != 0 || coordinates.size() / 3 != points)
      throw std::runtime_error("its Points have " + counted(coordinates.size(), "number") +
                               ", but NumberOfPoints is " + std::to_string(points) +
                               "; three are needed for each");
    addPoints(coordinates, geometry);
  }
  for (const pugi::xml_node& array : piece.child("PointData").children("DataArray")) {
    if (std::string_view(array.attribute("type").value()) == "String") continue;
    const std::uint64_t components =
        array.attribute("NumberOfComponents") ? countOf(array, "NumberOfComponents") : 1;
    addAttribute(array.attribute("Name").value(), components, numbersOf<float>(array, file), geometry);
  }
  takeCells(piece, "Polys", "NumberOfPolys", addPolygon, file, geometry);
  takeCells(piece, "Strips", "NumberOfStrips", addStrip, file, geometry);
  return geometry;
}

// Adds the points of a further piece, and what goes with them.
void append(Geometry& all, const Geometry& piece) {
  const auto before = static_cast<openvdb::Index32>(all.points.size());
  all.points.insert(all.points.end(), piece.points.begin(), piece.points.end());
  for (const openvdb::Vec3I& triangle : piece.triangles)
    all.triangles.push_back(triangle + openvdb::Vec3I(before));
  for (auto& [name, attribute] : all.attributes) {
    const auto more = piece.attributes.find(name);
    if (more == piece.attributes.end() || more->second.components != attribute.components)
      throw std::runtime_error("its array " + sim::inQuotes(name) +
                               " is not in all its pieces; every piece has the same");
    attribute.values.insert(attribute.values.end(), more->second.values.begin(), more->second.values.end());
  }
}

}  // namespace

Geometry geometryOfVtp(std::string_view bytes) {
  std::string_view appended;
  const pugi::xml_document document = documentOf(bytes, appended);
  const pugi::xml_node root = document.child("VTKFile");
  if (!root) throw std::runtime_error("is no VTK file: it has no element VTKFile");
  if (const std::string_view kind = root.attribute("type").value(); kind != "PolyData")
    throw std::runtime_error("is of type " + sim::inQuotes(kind) +
                             "; PolyData is read: extract the surface, or the particles as points");
  XmlArrays file = arraysOf(root, appended);
  file.room = bytes.size();
  Geometry all;
  for (const pugi::xml_node& node : root.child("PolyData").children("Piece")) {
    Geometry piece = geometryOf(node, file);
    if (piece.points.empty()) continue;
    if (all.points.empty())
      all = std::move(piece);
    else
      append(all, piece);
  }
  return all;
}

}  // namespace fluidtex::caches
