// Kitware, "VTK File Formats", simple legacy formats; of 5.x what vtkDataWriter of VTK 9 writes. VTK itself
// is not linked: Debian's libvtk9-dev cannot be installed beside python3-paraview, which many who have such
// files use.
#include "caches/formats/build_geometry.h"
#include "caches/formats/geometry_formats.h"
#include "caches/formats/vtk_cells.h"
#include "caches/formats/vtk_text_arrays.h"
#include "sim/meshes/text_scan.h"

namespace fluidtex::caches {

namespace {

using Words = std::string_view;

// %20 for a blank, and the like.
std::string decoded(std::string_view name) {
  std::string text;
  for (std::size_t n = 0; n < name.size(); ++n) {
    unsigned code = 0;
    const char* const digits = name.data() + n + 1;
    if (name[n] == '%' && n + 2 < name.size() &&
        std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      text += static_cast<char>(code);
      n += 2;
    } else {
      text += name[n];
    }
  }
  return text;
}

class VtkReader {
 public:
  explicit VtkReader(std::string_view bytes) : m_arrays(bytes) {}

  Geometry read() {
    takeHeader();
    for (Words words = m_arrays.takeLine(); !words.empty(); words = m_arrays.takeLine()) {
      const std::string keyword = sim::inLowerCase(sim::takeWord(words));
      try {
        takePart(keyword, words);
      } catch (const std::runtime_error& error) {
        throw std::runtime_error(sim::inQuotes(keyword) + ": " + error.what());
      }
    }
    addCells(m_polygons.corners, m_polygons.ends, addPolygon, m_geometry);
    addCells(m_strips.corners, m_strips.ends, addStrip, m_geometry);
    addCellsOfKinds(m_cells.corners, m_cells.ends, m_kinds, m_geometry);
    return std::move(m_geometry);
  }

 private:
  struct Cells {
    std::vector<std::int64_t> corners, ends;
  };

  void takeHeader() {
    if (!m_arrays.takeLine().starts_with("# vtk DataFile Version"))
      throw std::runtime_error("is no VTK file: it does not begin with '# vtk DataFile Version'");
    m_arrays.takeTitle();
    Words words = m_arrays.takeLine();
    const std::string kind = sim::inLowerCase(sim::takeWord(words));
    if (kind != "ascii" && kind != "binary")
      throw std::runtime_error("says " + sim::inQuotes(kind) +
                               " in its third line; expected ASCII or BINARY");
    m_arrays.binary = kind == "binary";
  }

  void takePart(const std::string& keyword, Words words) {
    if (keyword == "dataset") {
      const Words kind = sim::takeWord(words);
      const std::string lower = sim::inLowerCase(kind);
      if (lower != "polydata" && lower != "unstructured_grid")
        throw std::runtime_error(
            "is of kind " + sim::inQuotes(kind) +
            "; POLYDATA and UNSTRUCTURED_GRID are read: export the surface or the particles");
    } else if (keyword == "points") {
      const std::uint64_t count = takeCount(words);
      m_geometry.points.clear();
      addPoints(m_arrays.take<float>(arrayType(sim::takeWord(words)), count, 3), m_geometry);
    } else if (keyword == "vertices" || keyword == "lines") {
      takeCells(words);
    } else if (keyword == "polygons") {
      m_polygons = takeCells(words);
    } else if (keyword == "triangle_strips") {
      m_strips = takeCells(words);
    } else if (keyword == "cells") {
      m_cells = takeCells(words);
    } else if (keyword == "cell_types") {
      m_kinds = m_arrays.take<std::int64_t>({NumberType::int32}, takeCount(words), 1);
    } else if (keyword == "point_data" || keyword == "cell_data") {
      m_rows = takeCount(words);
      m_atPoints = keyword == "point_data";
      if (m_atPoints && m_rows != m_geometry.points.size())
        throw std::runtime_error("has " + counted(m_rows, "row") + " for " +
                                 counted(m_geometry.points.size(), "point") + "; one is needed for each");
    } else if (keyword == "field") {
      takeField(words);
    } else if (keyword == "metadata") {
      m_arrays.skipParagraph();
    } else {
      takeAttribute(keyword, words);
    }
  }

  // In the layout of before 5.0, the number of corners before those of each cell; or where each begins, and
  // all corners, whose numbers of numbers the line then has.
  Cells takeCells(Words words) {
    const std::uint64_t count = takeCount(words), size = takeCount(words);
    Cells cells;
    if (m_arrays.nextIs("OFFSETS")) {
      cells.ends = takeNamed("offsets", count);
      cells.corners = takeNamed("connectivity", size);
      if (!cells.ends.empty()) cells.ends.erase(cells.ends.begin());
      return cells;
    }
    const std::vector<std::int64_t> numbers = m_arrays.take<std::int64_t>({NumberType::int32}, size, 1);
    if (count > size)
      throw std::runtime_error(counted(count, "cell") + " in " + counted(size, "number") +
                               "; each begins with how many corners it has");
    cells.ends.reserve(count);
    cells.corners.reserve(size - count);
    std::size_t at = 0;
    for (std::uint64_t n = 0; n < count; ++n) {
      const std::int64_t corners = at < size ? numbers[at++] : -1;
      if (corners < 0 || std::uint64_t(corners) > size - at)
        throw std::runtime_error("cell " + std::to_string(n + 1) + " of " + std::to_string(count) +
                                 " does not fit into the " + counted(size, "number") + " of them all");
      const auto begin = numbers.begin() + std::ptrdiff_t(at);
      cells.corners.insert(cells.corners.end(), begin, begin + std::ptrdiff_t(corners));
      cells.ends.push_back(std::int64_t(cells.corners.size()));
      at += std::size_t(corners);
    }
    return cells;
  }

  std::vector<std::int64_t> takeNamed(const std::string& name, std::uint64_t count) {
    Words words = m_arrays.takeLine();
    const Words word = sim::takeWord(words);
    if (sim::inLowerCase(word) != name)
      throw std::runtime_error("has " + sim::inQuotes(word) + " where " + name + " should be");
    return m_arrays.take<std::int64_t>(arrayType(sim::takeWord(words)), count, 1);
  }

  // Arrays: their name, how many numbers make a row, how many rows, and the type. Fewer than announced where
  // the file ends: SPlisHSPlasH counts attributes that it then leaves out.
  void takeField(Words words) {
    sim::takeWord(words);
    for (std::uint64_t count = takeCount(words); count > 0; --count) {
      Words line = m_arrays.takeLine();
      if (line == "METADATA") {
        m_arrays.skipParagraph();
        line = m_arrays.takeLine();
      }
      if (line.empty()) return;
      const Words name = sim::takeWord(line);
      const std::uint64_t components = takeCount(line), rows = takeCount(line);
      keep(name, arrayType(sim::takeWord(line)), rows, components);
    }
  }

  void takeAttribute(const std::string& keyword, Words words) {
    const Words name = sim::takeWord(words);
    if (keyword == "scalars") {
      const ArrayType type = arrayType(sim::takeWord(words));
      const std::uint64_t components = words.find_first_not_of(" \t") == Words::npos ? 1 : takeCount(words);
      if (m_arrays.nextIs("LOOKUP_TABLE")) m_arrays.takeLine();
      keep(name, type, m_rows, components);
    } else if (keyword == "color_scalars") {
      keep(name, m_arrays.bytesOrText(), m_rows, takeCount(words));
    } else if (keyword == "lookup_table") {
      m_arrays.skip(m_arrays.bytesOrText(), takeCount(words), 4);
    } else if (keyword == "texture_coordinates") {
      const std::uint64_t components = takeCount(words);
      keep(name, arrayType(sim::takeWord(words)), m_rows, components);
    } else {
      const std::uint64_t components =
          keyword == "vectors" || keyword == "normals"                                      ? 3
          : keyword == "tensors"                                                            ? 9
          : keyword == "tensors6"                                                           ? 6
          : keyword == "global_ids" || keyword == "pedigree_ids" || keyword == "edge_flags" ? 1
                                                                                            : 0;
      if (components == 0) throw std::runtime_error("begins no part of a VTK file that is known");
      keep(name, arrayType(sim::takeWord(words)), m_rows, components);
    }
  }

  void keep(Words name, ArrayType type, std::uint64_t rows, std::uint64_t components) {
    if (m_atPoints && type.isNumber() && components > 0)
      addAttribute(decoded(name), components, m_arrays.take<float>(type, rows, components), m_geometry);
    else
      m_arrays.skip(type, rows, components);
  }

  static std::uint64_t takeCount(Words& words) {
    const Words word = sim::takeWord(words);
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (word.empty() || error != std::errc() || end != word.data() + word.size())
      throw std::runtime_error("needs a whole number of 0 or more, and has " + sim::inQuotes(word));
    return count;
  }

  TextArrays m_arrays;
  Geometry m_geometry;
  Cells m_polygons, m_strips, m_cells;
  std::vector<std::int64_t> m_kinds;
  std::uint64_t m_rows = 0;
  bool m_atPoints = false;
};

}  // namespace

Geometry geometryOfVtk(std::string_view bytes) {
  return VtkReader(bytes).read();
}

}  // namespace fluidtex::caches
