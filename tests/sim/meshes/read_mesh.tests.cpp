// Meshes as programs write them: each is read, or refused with its true reason.
#include "sim/meshes/read_mesh.h"

#include "tests/sim/meshes/mesh_files.h"
#include "tests/sim/meshes/written_files.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;

namespace {

constexpr double kVolume = 0.4 * 0.4 * 0.7;
const Vec3d kLow(0.3, 0.3, -0.1), kHigh(0.7, 0.7, 0.6);
const std::vector<std::vector<int>> kFaces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                           {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

Vec3d cornerOf(int n) {
  return {n % 4 == 0 || n % 4 == 3 ? kLow.x() : kHigh.x(), n % 4 < 2 ? kLow.y() : kHigh.y(),
          n < 4 ? kLow.z() : kHigh.z()};
}

std::string box() {
  return boxObj(kLow, kHigh);
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// The box as facets of text.
std::string textStl() {
  std::string text = "solid box\n";
  for (const auto& face : kFaces) {
    for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      text += " facet normal 0 0 0\n  outer loop\n";
      for (const int c : corners) {
        const Vec3d x = cornerOf(face[std::size_t(c)]);
        text += "   vertex " + std::to_string(x.x()) + " " + std::to_string(x.y()) + " " +
                std::to_string(x.z()) + "\n";
      }
      text += "  endloop\n endfacet\n";
    }
  }
  return text + "endsolid box\n";
}

std::string binaryStl(const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  append(bytes, std::uint32_t(12));
  for (const auto& face : kFaces) {
    for (const auto& corners : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      append(bytes, std::array<float, 3>{});
      for (const int c : corners) {
        const Vec3d x = cornerOf(face[std::size_t(c)]);
        append(bytes, std::array<float, 3>{float(x.x()), float(x.y()), float(x.z())});
      }
      append(bytes, std::uint16_t(0));
    }
  }
  return bytes;
}

std::string plyHeader(const std::string& format, const std::string& coordinate, const std::string& face) {
  std::string text = "ply\nformat " + format + " 1.0\ncomment a box\nelement vertex 8\n";
  for (const char axis : {'x', 'y', 'z'}) text += "property " + coordinate + " " + axis + "\n";
  return text + face + "end_header\n";
}

// Ten times as large, so that whole numbers will do.
template <class Coordinate, class Count, class Index>
std::string binaryPly(bool littleEndian, const std::string& coordinate, const std::string& count,
                      const std::string& index) {
  std::string bytes = plyHeader(littleEndian ? "binary_little_endian" : "binary_big_endian", coordinate,
                                "element face 6\nproperty list " + count + " " + index + " vertex_indices\n");
  const auto add = [&](auto value) {
    std::array<char, sizeof value> raw;
    std::memcpy(raw.data(), &value, sizeof value);
    if (!littleEndian) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
  };
  for (int n = 0; n < 8; ++n)
    for (int a = 0; a < 3; ++a) add(static_cast<Coordinate>(std::lround(10.0 * cornerOf(n)[a])));
  for (const auto& face : kFaces) {
    add(static_cast<Count>(4));
    for (const int vertex : face) add(static_cast<Index>(vertex));
  }
  return bytes;
}

std::string textPly(const std::string& index = "int", const std::string& coordinate = "float") {
  std::string text =
      plyHeader("ascii", coordinate, "element face 6\nproperty list uchar " + index + " vertex_indices\n");
  for (int n = 0; n < 8; ++n) {
    for (int a = 0; a < 3; ++a) text += std::to_string(std::lround(10.0 * cornerOf(n)[a])) + " ";
    text += "\n";
  }
  for (const auto& face : kFaces) {
    text += "4";
    for (const int vertex : face) text += " " + std::to_string(vertex);
    text += "\n";
  }
  return text;
}

std::string faultOf(const std::string& name, const std::string& content) {
  const WrittenFile file(name, content);
  try {
    readMesh(MeshShape{file.path});
  } catch (const MeshError& error) {
    CHECK_THAT(error.what(), Contains(name));
    return error.what();
  }
  return "no fault";
}

}  // namespace

TEST_CASE("mesh reader: an OBJ is read however its lines are written", "[sim]") {
  const std::string text =
      GENERATE(box(), replaced(box(), " ", "\t"), replaced(box(), " ", " \t "), replaced(box(), "\n", "\r\n"),
               replaced(box(), "\n", "\r"), "\xEF\xBB\xBFmtllib box.mtl\n" + box(), "\xEF\xBB\xBF" + box(),
               // A line goes on behind a backslash; a comment and a folder's name do not.
               replaced(replaced(box(), "4 3 2", "4 \\\n3 2"), " -0.1", " \\\r\n-0.1"),
               "# C:\\meshes\\\nmtllib C:\\meshes\\\n" + box(),
               // What is no face: loose edges, points, texture coordinates, normals, names.
               box() + "v 0.9 0.9 0.9\nv 0.95 0.9 0.9\nl 9 10\np 9\nf 9 10\n",
               "o box\ng box faces\nvt 0 0\nvn 0 0 1\nusemtl f\ns off\n" +
                   replaced(box(), "f 1 4 3 2", "f 1/1/1 4//1 3/1 2"),
               replaced(box(), "f 1 4 3 2", "f -8 -5 -6 -7 # the bottom"),
               replaced(box(), "v 0.300000", "v +3.0e-1"), replaced(box(), "\nv 0.7", "\nV 0.7"),
               // A vertex may come behind the face that names it.
               kBoxFaces + boxObj(kLow, kHigh, ""), box() + "f 1 1 2\nf 1 2 2 1\n");
  CAPTURE(text);
  const TriangleMesh mesh = meshOf("box.obj", text);
  CHECK(mesh.positions.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(volumeOf(mesh) == Approx(kVolume));
}

TEST_CASE("mesh reader: an STL is told by what it holds, in upper and lower case", "[sim]") {
  std::string upper = textStl();
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  const std::string content = GENERATE_COPY(
      textStl(), upper, replaced(textStl(), "solid box", "solid my solid vertex facet"),
      replaced(textStl(), "solid box", "solid"), textStl().substr(0, textStl().find("endsolid")),
      replaced(textStl(), "\n", "\r\n"), "\xEF\xBB\xBF" + textStl(), "\n  " + textStl(),
      "solid\n" + replaced(replaced(textStl().substr(10), "\n", " "), "endsolid", "\nendsolid"),
      binaryStl("a box"), binaryStl("solid box"), binaryStl("solid facet normal"), binaryStl(""),
      binaryStl("box") + "padding");
  CAPTURE(content);
  const TriangleMesh mesh = meshOf("box.stl", content);
  CHECK(mesh.positions.size() == 8);
  CHECK(volumeOf(mesh) == Approx(kVolume));
}

TEST_CASE("mesh reader: a PLY may have numbers of any type", "[sim]") {
  using std::int16_t, std::int32_t, std::int8_t, std::uint16_t, std::uint32_t, std::uint8_t;
  const std::string content =
      GENERATE(textPly(), textPly("ushort"), textPly("uchar"), textPly("uint8"), textPly("int16", "short"),
               textPly("float", "int16"), replaced(textPly(), "\n", "\r\n"),
               replaced(textPly(), "vertex_indices", "vertex_index"),
               binaryPly<float, uint8_t, int32_t>(true, "float", "uchar", "int"),
               binaryPly<double, int32_t, uint32_t>(true, "double", "int", "uint"),
               binaryPly<int16_t, uint8_t, uint16_t>(true, "short", "uchar", "ushort"),
               binaryPly<int8_t, int8_t, uint8_t>(true, "char", "char", "uchar"),
               binaryPly<int32_t, uint16_t, int16_t>(false, "int32", "uint16", "int16"),
               binaryPly<float, uint32_t, int8_t>(false, "float32", "uint32", "int8"),
               binaryPly<double, uint8_t, double>(false, "float64", "uint8", "float64"));
  CAPTURE(content);
  const TriangleMesh mesh = meshOf("box.ply", content, 0.1);
  CHECK(mesh.positions.size() == 8);
  CHECK(volumeOf(mesh) == Approx(kVolume));
}

TEST_CASE("mesh reader: a PLY's strips, properties and elements beside its faces", "[sim]") {
  std::string text =
      "ply\nformat ascii 1.0\nobj_info x\nelement material 1\nproperty list uchar float gloss\nproperty "
      "int kind\nelement vertex 8\nproperty float nx\nproperty float z\nproperty float x\nproperty "
      "float y\nproperty uchar red\nelement tristrips 1\nproperty list int int "
      "vertex_indices\nend_header\n2 0.5 0.5 7\n";
  for (int n = 0; n < 8; ++n) {
    const Vec3d x = cornerOf(n);
    text +=
        "1 " + std::to_string(x.z()) + " " + std::to_string(x.x()) + " " + std::to_string(x.y()) + " 255\n";
  }
  text += "30 0 3 1 2 -1 4 5 7 6 -1 0 1 4 5 -1 1 2 5 6 -1 2 3 6 7 -1 3 0 7 4 -1\n";
  CHECK(volumeOf(meshOf("strips.ply", text)) == Approx(kVolume));
}

TEST_CASE("mesh reader: what it cannot use it says, and where", "[sim]") {
  CHECK_THAT(faultOf("a.obj", box() + "f 1 2 x\n"), Contains("line 15: 'x'"));
  CHECK_THAT(faultOf("b.obj", box() + "f 1 2 9\n"),
             Contains("line 15") && Contains("vertex 9, but there are 8"));
  CHECK_THAT(faultOf("c.obj", box() + "f 1 2 0\n"), Contains("line 15") && Contains("vertex 0"));
  CHECK_THAT(faultOf("d.obj", box() + "f -9 1 2\n"), Contains("line 15") && Contains("-9"));
  CHECK_THAT(faultOf("e.obj", "v 1 2\n" + box()), Contains("line 1: a vertex needs three numbers"));
  CHECK_THAT(faultOf("f.obj", "v 0,5 1 2\n" + box()), Contains("line 1: '0,5' is not a number"));
  CHECK_THAT(faultOf("g.obj", box() + "surf 0 1 0 1 1 2 3 4\n"),
             Contains("line 15") && Contains("free-form"));
  CHECK_THAT(faultOf("h.obj", "v nan 1 2\n" + box()), Contains("vertex 1") && Contains("finite"));
  CHECK_THAT(faultOf("i.obj", "v 1e30 1 2\n" + box()), Contains("m away"));
  CHECK_THAT(faultOf("j.obj", "\xFF\xFEv"), Contains("UTF-16"));
  CHECK_THAT(faultOf("k.obj", "nothing of that kind"), Contains("no vertices and no faces"));
  CHECK_THAT(faultOf("l.obj", replaced(box(), "f 1 4 3 2\n", "")),
             Contains("4 edges have a face on one side only"));
  // A wall of one face across the box.
  CHECK_THAT(faultOf("m.obj", box() + "f 1 2 7 8\n"), Contains("not closed") && Contains("three faces meet"));

  CHECK_THAT(faultOf("a.stl", replaced(textStl(), "0.3", "0.3x")), Contains("line 4: '0.3"));
  CHECK_THAT(faultOf("b.stl", textStl().substr(0, 400)), Contains("line "));
  CHECK_THAT(faultOf("c.stl", binaryStl("").substr(0, 500)), Contains("cut short") && Contains("12 facets"));

  CHECK_THAT(faultOf("a.ply", replaced(textPly(), "vertex 8", "vertex 4000000000")),
             Contains("4000000000 elements 'vertex'") && Contains("too short"));
  CHECK_THAT(faultOf("b.ply", replaced(textPly(), "vertex 8", "vertex -1")),
             Contains("line 4") && Contains("'-1'"));
  CHECK_THAT(faultOf("c.ply", replaced(textPly(), "float x", "half x")), Contains("line 5: 'half'"));
  CHECK_THAT(faultOf("d.ply", replaced(textPly(), "property float x", "proty float x")),
             Contains("line 5: 'proty'"));
  CHECK_THAT(faultOf("e.ply", replaced(textPly(), "float y", "float v")), Contains("no property 'y'"));
  CHECK_THAT(faultOf("f.ply", replaced(textPly(), "4 0 3 2 1", "-4 0 3 2 1")),
             Contains("face 1 of 6") && Contains("-4"));
  CHECK_THAT(faultOf("g.ply", replaced(textPly(), "4 0 3 2 1", "4 0 3 2 8")),
             Contains("vertex 8") && Contains("there are 8"));
  CHECK_THAT(faultOf("h.ply", replaced(textPly(), "4 0 3 2 1", "4 0 3 2.5 1")), Contains("2.5"));
  std::string bytes = binaryPly<float, std::uint32_t, std::int32_t>(true, "float", "uint", "int");
  bytes.replace(bytes.find("end_header\n") + 11 + 8 * 12, 4, "\xFF\xFF\xFF\xFF");
  CHECK_THAT(faultOf("i.ply", bytes), Contains("4294967295 numbers") && Contains("too short"));
}
