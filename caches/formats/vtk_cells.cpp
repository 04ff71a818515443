#include "caches/formats/vtk_cells.h"

#include "caches/formats/build_geometry.h"

#include <array>
#include <stdexcept>

namespace fluidtex::caches {

namespace {

void addCell(std::span<const std::int64_t> corners, std::int64_t kind, std::size_t number,
             Geometry& geometry) {
  constexpr std::int64_t kPolyLine = 4, kTriangle = 5, kStrip = 6, kPolygon = 7, kPixel = 8, kQuad = 9;
  if (kind >= 0 && kind <= kPolyLine) return;  // empty, vertices, lines
  if (kind == kStrip) {
    addStrip(corners, number, geometry);
  } else if (kind == kPixel && corners.size() == 4) {
    addPolygon(std::array{corners[0], corners[1], corners[3], corners[2]}, number, geometry);
  } else if (kind == kTriangle || kind == kPolygon || kind == kPixel || kind == kQuad) {
    addPolygon(corners, number, geometry);
  } else {
    throw std::runtime_error("cell " + std::to_string(number + 1) + " is of type " + std::to_string(kind) +
                             "; only vertices, lines, triangles, strips and polygons (1 to 9) are read: "
                             "extract the surface of a grid of solid cells and triangulate curved ones");
  }
}

}  // namespace

void addCellsOfKinds(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends,
                     std::span<const std::int64_t> kinds, Geometry& geometry) {
  if (ends.size() != kinds.size())
    throw std::runtime_error("has " + counted(ends.size(), "cell") + " and " + counted(kinds.size(), "type") +
                             " of them; one is needed for each");
  std::int64_t begin = 0;
  for (std::size_t n = 0; n < ends.size(); ++n) {
    addCell(cornersOf(corners, begin, ends[n], n), kinds[n], n, geometry);
    begin = ends[n];
  }
}

}  // namespace fluidtex::caches
