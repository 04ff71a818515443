#include "tests/caches/formats/pyramid_files.h"

namespace fluidtex::caches {

std::string base64Of(const std::string& bytes) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (n + k < bytes.size() ? static_cast<unsigned char>(bytes[n + k]) : 0u);
    for (int k = 0; k < 4; ++k)
      text += n + std::size_t(k) > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

namespace {

class Writer {
 public:
  explicit Writer(const VtpOptions& options) : m_options(options) {}

  std::string array(const std::string& name, const std::string& type, int components,
                    const std::vector<double>& numbers) {
    std::string element = "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                          std::to_string(components) + "\"";
    if (m_options.format == VtpOptions::ascii)
      return element + " format=\"ascii\">\n" + textOf(numbers) + "</DataArray>\n";
    const std::endian order = m_options.bigEndian ? std::endian::big : std::endian::little;
    const std::string values = type == "Float32"   ? bytesOf<float>(numbers, order)
                               : type == "Float64" ? bytesOf<double>(numbers, order)
                               : type == "Int64"   ? bytesOf<std::int64_t>(numbers, order)
                               : type == "UInt8"   ? bytesOf<std::uint8_t>(numbers, order)
                                                   : bytesOf<std::int32_t>(numbers, order);
    const std::string data = encoded(values);
    if (m_options.format == VtpOptions::inlined)
      return element + " format=\"binary\">\n  " + data + "\n</DataArray>\n";
    element += " format=\"appended\" offset=\"" + std::to_string(m_appended.size()) + "\"/>\n";
    m_appended += data;
    return element;
  }

  std::string whole(const std::string& pieces) const {
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"";
    xml += m_options.bigEndian ? "BigEndian\"" : "LittleEndian\"";
    if (m_options.longHeader) xml += " header_type=\"UInt64\"";
    if (m_options.packed) xml += " compressor=\"vtkZLibDataCompressor\"";
    xml += ">\n<PolyData>\n" + pieces + "</PolyData>\n";
    if (m_options.format == VtpOptions::appendedRaw)
      xml += "<AppendedData encoding=\"raw\">\n  _" + m_appended + "\n</AppendedData>\n";
    if (m_options.format == VtpOptions::appendedBase64)
      xml += "<AppendedData encoding=\"base64\">\n  _" + m_appended + "\n</AppendedData>\n";
    return xml + "</VTKFile>\n";
  }

 private:
  std::string lengths(const std::vector<double>& numbers) const {
    const std::endian order = m_options.bigEndian ? std::endian::big : std::endian::little;
    return m_options.longHeader ? bytesOf<std::uint64_t>(numbers, order)
                                : bytesOf<std::uint32_t>(numbers, order);
  }

  std::string encoded(const std::string& values) const {
    const bool isRaw = m_options.format == VtpOptions::appendedRaw;
    if (!m_options.packed) {
      const std::string bytes = lengths({double(values.size())}) + values;
      return isRaw ? bytes : base64Of(bytes);
    }
    const std::size_t size = m_options.blockSize, count = (values.size() + size - 1) / size;
    std::vector<double> header{double(count), double(size), double(values.size() % size)};
    std::string blocks;
    for (std::size_t n = 0; n < count; ++n) {
      const std::string block = zlibbed(values.substr(n * size, size));
      header.push_back(double(block.size()));
      blocks += block;
    }
    return isRaw ? lengths(header) + blocks : base64Of(lengths(header)) + base64Of(blocks);
  }

  VtpOptions m_options;
  std::string m_appended;
};

}  // namespace

std::string vtp(const VtpOptions& options) {
  Writer writer(options);
  std::string pieces;
  const auto addPiece = [&](const std::vector<std::vector<double>>& cells) {
    std::vector<double> corners, ends;
    for (const auto& cell : cells) {
      corners.insert(corners.end(), cell.begin(), cell.end());
      ends.push_back(double(corners.size()));
    }
    const std::string name = options.asStrips ? "Strips" : "Polys";
    pieces += "<Piece NumberOfPoints=\"5\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOf" + name + "=\"" +
              std::to_string(cells.size()) + "\">\n";
    pieces +=
        "<PointData Vectors=\"velocity\">\n" + writer.array("velocity", "Float32", 3, kPyramidSpeeds) +
        writer.array("id", "Int64", 1, {9, 8, 7, 6, 5}) +
        "<Array type=\"String\" Name=\"kind\" format=\"ascii\">97 0</Array>\n</PointData>\n<CellData/>\n";
    pieces += "<Points>\n" + writer.array("Points", "Float64", 3, kPyramid) + "</Points>\n";
    pieces += "<Verts>\n" + writer.array("connectivity", "Int64", 1, {}) +
              writer.array("offsets", "Int64", 1, {}) + "</Verts>\n";
    pieces += "<" + name + ">\n" + writer.array("connectivity", "Int32", 1, corners) +
              writer.array("offsets", "Int64", 1, ends) + "</" + name + ">\n</Piece>\n";
  };
  if (options.asStrips) {
    addPiece({{0, 1, 4, 2}, {2, 3, 4, 0}, {3, 2, 0, 1}});
  } else if (options.inTwoPieces) {
    addPiece({kPyramidFaces.begin(), kPyramidFaces.begin() + 2});
    addPiece({kPyramidFaces.begin() + 2, kPyramidFaces.end()});
  } else {
    addPiece(kPyramidFaces);
  }
  return writer.whole(pieces);
}

}  // namespace fluidtex::caches
