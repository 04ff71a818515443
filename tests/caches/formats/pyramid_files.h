// The pyramid in every format.
#pragma once

#include "tests/caches/formats/written_bytes.h"

namespace fluidtex::caches {

inline std::vector<std::vector<double>> pyramidTriangles() {
  std::vector<std::vector<double>> triangles{{0, 3, 2}, {0, 2, 1}};
  triangles.insert(triangles.end(), kPyramidFaces.begin() + 1, kPyramidFaces.end());
  return triangles;
}

inline std::string bobj(bool withNormals, bool withTriangles = true) {
  std::string bytes;
  put(bytes, std::int32_t(5));
  bytes += bytesOf<float>(kPyramid);
  if (withNormals) {
    put(bytes, std::int32_t(5));
    bytes += bytesOf<float>(std::vector<double>(15, 0.25));
  }
  if (!withTriangles) return bytes;
  put(bytes, std::int32_t(6));
  for (const auto& triangle : pyramidTriangles()) bytes += bytesOf<std::int32_t>(triangle);
  return bytes;
}

struct BgeoOptions {
  bool asRun = true, withVertexAttribute = false, withText = false;
  int particles = 0;        // of a particle system behind the polygons
  std::int32_t points = 5;  // those behind the pyramid's lie at 0
};

inline void putName(std::string& bytes, const std::string& name) {
  put(bytes, std::uint16_t(name.size()), std::endian::big);
  bytes += name;
}

inline std::string bgeo(const BgeoOptions& options = {}) {
  constexpr auto kBig = std::endian::big;
  std::string bytes = "BgeoV";
  const std::int32_t primitives = 5 + (options.particles > 0);
  for (const std::int32_t n : {5, options.points, primitives, 0, 0, options.withText ? 3 : 2,
                               options.withVertexAttribute ? 1 : 0, 1, 0})
    put(bytes, n, kBig);
  putName(bytes, "v");
  put(bytes, std::uint16_t(3), kBig);
  put(bytes, std::int32_t(5), kBig);
  bytes += bytesOf<float>({0, 0, 0}, kBig);
  if (options.withText) {
    putName(bytes, "material");
    put(bytes, std::uint16_t(1), kBig);
    put(bytes, std::int32_t(4), kBig);
    put(bytes, std::int32_t(2), kBig);
    putName(bytes, "water");
    putName(bytes, "");
  }
  putName(bytes, "id");
  put(bytes, std::uint16_t(1), kBig);
  put(bytes, std::int32_t(1), kBig);
  put(bytes, std::int32_t(-1), kBig);
  for (std::int32_t n = 0; n < options.points; ++n) {
    for (std::size_t a = 0; a < 3; ++a)
      put(bytes, n < 5 ? float(kPyramid[3 * std::size_t(n) + a]) : 0.0f, kBig);
    put(bytes, 1.0f, kBig);
    for (std::size_t a = 0; a < 3; ++a)
      put(bytes, n < 5 ? float(kPyramidSpeeds[3 * std::size_t(n) + a]) : 0.0f, kBig);
    if (options.withText) put(bytes, std::int32_t(n % 2), kBig);
    put(bytes, std::int32_t(100 + n), kBig);
  }
  if (options.withVertexAttribute) {
    putName(bytes, "uv");
    put(bytes, std::uint16_t(3), kBig);
    put(bytes, std::int32_t(0), kBig);
    bytes += bytesOf<float>({0, 0, 0}, kBig);
  }
  putName(bytes, "Cd");
  put(bytes, std::uint16_t(1), kBig);
  put(bytes, std::int32_t(0), kBig);
  put(bytes, 1.0f, kBig);
  const auto putCorner = [&](double corner) {
    options.points > 65535 ? put(bytes, std::uint32_t(corner), kBig)
                           : put(bytes, std::uint16_t(corner), kBig);
    if (options.withVertexAttribute) bytes += bytesOf<float>({7, 8, 9}, kBig);
  };
  if (options.asRun) {
    put(bytes, std::int32_t(-1), kBig);
    put(bytes, std::uint16_t(5), kBig);
    put(bytes, std::int32_t(1), kBig);
  }
  for (const auto& face : kPyramidFaces) {
    if (!options.asRun) put(bytes, std::int32_t(1), kBig);
    put(bytes, std::int32_t(face.size()), kBig);
    bytes += '<';
    for (const double corner : face) putCorner(corner);
    put(bytes, 0.5f, kBig);  // Cd
  }
  if (options.particles > 0) {
    put(bytes, std::int32_t(0x8000), kBig);
    put(bytes, std::int32_t(options.particles), kBig);
    for (int n = 0; n < options.particles; ++n) putCorner(n);
    put(bytes, 0.5f, kBig);
  }
  return bytes + '\0' + '\xff';
}

struct VtkOptions {
  bool binary = false, asDouble = false, newCells = false, unstructured = false, asStrips = false,
       withTexts = false;
};

// Arrays as legacy files have them.
inline std::string vtkArray(const VtkOptions& options, const std::string& type,
                            const std::vector<double>& numbers) {
  if (!options.binary) return textOf(numbers);
  constexpr auto kBig = std::endian::big;
  return (type == "float"           ? bytesOf<float>(numbers, kBig)
          : type == "double"        ? bytesOf<double>(numbers, kBig)
          : type == "vtktypeint64"  ? bytesOf<std::int64_t>(numbers, kBig)
          : type == "unsigned_char" ? bytesOf<std::uint8_t>(numbers, kBig)
                                    : bytesOf<std::int32_t>(numbers, kBig)) +
         "\n";
}

inline std::string vtkCells(const VtkOptions& options, const std::string& keyword,
                            const std::vector<std::vector<double>>& cells) {
  std::vector<double> old, ends{0}, corners;
  for (const auto& cell : cells) {
    old.push_back(double(cell.size()));
    old.insert(old.end(), cell.begin(), cell.end());
    corners.insert(corners.end(), cell.begin(), cell.end());
    ends.push_back(double(corners.size()));
  }
  if (!options.newCells)
    return keyword + " " + std::to_string(cells.size()) + " " + std::to_string(old.size()) + "\n" +
           vtkArray(options, "int", old);
  return keyword + " " + std::to_string(ends.size()) + " " + std::to_string(corners.size()) +
         "\nOFFSETS vtktypeint64\n" + vtkArray(options, "vtktypeint64", ends) +
         "CONNECTIVITY vtktypeint64\n" + vtkArray(options, "vtktypeint64", corners);
}

inline std::string vtk(const VtkOptions& options = {}) {
  const std::string real = options.asDouble ? "double" : "float";
  std::string bytes = std::string("# vtk DataFile Version ") + (options.newCells ? "5.1" : "3.0") +
                      "\na pyramid\n" + (options.binary ? "BINARY\n" : "ASCII\n") + "DATASET " +
                      (options.unstructured ? "UNSTRUCTURED_GRID" : "POLYDATA") + "\n";
  bytes += "FIELD FieldData 1\nTIME 1 1 double\n" + vtkArray(options, "double", {0.5});
  bytes += "POINTS 5 " + real + "\n" + vtkArray(options, real, kPyramid);
  bytes += "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n";
  // Two strips: around the apex' edges, and the base.
  const std::vector<std::vector<double>> strips{{0, 1, 4, 2}, {2, 3, 4, 0}, {3, 2, 0, 1}};
  auto cells = options.asStrips ? strips : kPyramidFaces;
  if (options.unstructured) {
    std::vector<double> kinds{7, 5, 5, 5, 5};
    if (options.asStrips) kinds.assign(3, 6);
    cells.push_back({2});  // a vertex
    cells.push_back({0, 4});
    kinds.insert(kinds.end(), {1, 3});
    bytes += vtkCells(options, "CELLS", cells) + "\nCELL_TYPES " + std::to_string(kinds.size()) + "\n" +
             vtkArray(options, "int", kinds);
  } else {
    bytes += vtkCells(options, "VERTICES", {{0}, {1, 2}}) + vtkCells(options, "LINES", {{0, 1, 2}});
    bytes += vtkCells(options, options.asStrips ? "TRIANGLE_STRIPS" : "POLYGONS", cells);
  }
  bytes += "CELL_DATA " + std::to_string(cells.size()) + "\nSCALARS area float\nLOOKUP_TABLE default\n" +
           vtkArray(options, "float", std::vector<double>(cells.size(), 0.5));
  bytes += "POINT_DATA 5\nSCALARS heat%20C float 1\nLOOKUP_TABLE warm\n" +
           vtkArray(options, "float", {1, 2, 3, 4, 5});
  bytes += "LOOKUP_TABLE warm 2\n" +
           vtkArray(options, options.binary ? "unsigned_char" : "float", std::vector<double>(8, 1));
  bytes += "VECTORS velocity " + real + "\n" + vtkArray(options, real, kPyramidSpeeds);
  bytes += std::string("FIELD FieldData ") + (options.withTexts ? "3" : "2") + "\nId 1 5 int\n" +
           vtkArray(options, "int", {10, 11, 12, 13, 14});
  if (options.withTexts) {
    bytes += "kind 1 5 string\n";
    for (const std::string text : {"a", "", "water", "b b", "c"})
      bytes += options.binary ? std::string(1, char(0xC0 | text.size())) + text : text + "\n";
    bytes += "\n";
  }
  bytes += "METADATA\nCOMPONENT_NAMES\nu\nv\n\nuv 2 5 " + real + "\n" +
           vtkArray(options, real, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  return bytes;
}

struct VtpOptions {
  enum Format { ascii, inlined, appendedRaw, appendedBase64 } format = ascii;
  bool packed = false, longHeader = false, bigEndian = false, asStrips = false, inTwoPieces = false;
  std::size_t blockSize = 32;
};

std::string base64Of(const std::string& bytes);

std::string vtp(const VtpOptions& options = {});

}  // namespace fluidtex::caches
