#include "caches/formats/read_geometry.h"

#include "caches/formats/file_content.h"
#include "caches/formats/geometry_formats.h"
#include "sim/meshes/text_scan.h"

#include <array>

namespace fluidtex::caches {

namespace {

struct Format {
  std::string_view ending;
  Geometry (*read)(std::string_view);
};

constexpr std::array<Format, 8> kFormats{{{".ply", geometryOfPly},
                                          {".obj", geometryOfObj},
                                          {".stl", geometryOfStl},
                                          {".vtp", geometryOfVtp},
                                          {".vtk", geometryOfVtk},
                                          {".bobj", geometryOfBobj},
                                          {".bgeo", geometryOfBgeo},
                                          {".bhclassic", geometryOfBgeo}}};

struct Unread {
  std::string_view ending, advice;
};

constexpr std::string_view kHoudini =
    "is a compressed or newer Houdini format, which is not read; write .vdb or .ply with a File Cache or ROP "
    "Geometry "
    "Output node, or classic geometry with the ending .bhclassic";
constexpr std::string_view kUsd =
    "is a USD scene, which is not read; export its surface as a sequence of .ply or .obj files, or its level "
    "set as "
    ".vdb";
constexpr std::string_view kVtk =
    "is a VTK format that is not read; save the surface as .vtp or .vtk (Extract Surface, then Save Data, in "
    "ParaView)";

constexpr std::array<Unread, 15> kUnread{
    {{".bgeo.sc", kHoudini},
     {".bgeo.lzma", kHoudini},
     {".geo", kHoudini},
     {".sim",
      "holds the state of a Houdini simulation, which is not read; write its surface and velocity as .vdb "
      "with a "
      "File Cache or ROP Geometry Output node"},
     {".aur",
      "is a Phoenix cache, which is not read; let Phoenix write .vdb, or convert it with Phoenix's cache "
      "converter"},
     {".bif", "is a Bifrost cache, which is not read; write .vdb from Bifrost's graph"},
     {".abc", "is an Alembic archive, which is not read; export a sequence of .ply or .obj files"},
     {".usd", kUsd},
     {".usda", kUsd},
     {".usdc", kUsd},
     {".usdz", kUsd},
     {".vtu", kVtk},
     {".vti", kVtk},
     {".pvd", kVtk},
     {".pvtp", kVtk}}};

bool endsWith(const std::string& name, std::string_view ending) {
  return name.size() > ending.size() && name.ends_with(ending);
}

std::string nameOf(const std::filesystem::path& file) {
  return sim::inLowerCase(file.filename().string());
}

const Format* formatOf(const std::filesystem::path& file) {
  std::string name = nameOf(file);
  constexpr std::string_view kPacked = ".gz";
  if (endsWith(name, kPacked)) name.resize(name.size() - kPacked.size());
  for (const Format& format : kFormats)
    if (endsWith(name, format.ending)) return &format;
  return nullptr;
}

const Format& formatOrFail(const std::filesystem::path& file) {
  if (const std::string advice = adviceFor(file); !advice.empty()) fail(file, advice);
  const Format* format = formatOf(file);
  if (!format)
    fail(file,
         "is of no kind of geometry file that is read; expected .ply, .obj, .stl, .vtp, .vtk, .bobj, "
         ".bobj.gz, .bgeo or .bhclassic");
  return *format;
}

}  // namespace

bool isGeometryFile(const std::filesystem::path& file) {
  return formatOf(file) != nullptr;
}

std::string adviceFor(const std::filesystem::path& file) {
  const std::string name = nameOf(file);
  for (const Unread& unread : kUnread)
    if (endsWith(name, unread.ending)) return std::string(unread.advice);
  return {};
}

Geometry geometryOf(const std::filesystem::path& file, std::string bytes) {
  const Format& format = formatOrFail(file);
  const std::string content = unpacked(file, std::move(bytes));
  Geometry geometry;
  try {
    geometry = format.read(content);
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
  for (std::size_t n = 0; n < geometry.points.size(); ++n)
    if (!geometry.points[n].isFinite())
      fail(file, "point " + std::to_string(n + 1) + " of " + std::to_string(geometry.points.size()) +
                     " is not at finite numbers; write it anew");
  return geometry;
}

Geometry readGeometry(const std::filesystem::path& file) {
  formatOrFail(file);
  return geometryOf(file, bytesOf(file));
}

}  // namespace fluidtex::caches
