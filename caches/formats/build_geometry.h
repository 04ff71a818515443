// A geometry put together from the arrays of a file.
#pragma once

#include "caches/formats/geometry.h"

#include <cstdint>
#include <span>
#include <string>

namespace fluidtex::caches {

// Adds points. #coordinates: a multiple of 3.
void addPoints(std::span<const float> coordinates, Geometry& geometry);

// Adds an attribute in place of one of its name. Throws std::runtime_error where it is not one row of values
// for each point.
void addAttribute(const std::string& name, std::uint64_t components, std::vector<float> values,
                  Geometry& geometry);

// These throw std::runtime_error where a corner is no point. `number` is that of the polygon or strip among
// those of its kind, from 0 on.

// Adds a polygon, cut into triangles where it has more than three corners. One of fewer bounds nothing.
void addPolygon(std::span<const std::int64_t> corners, std::size_t number, Geometry& geometry);

// Adds a triangle strip: every corner makes a triangle with the two before it, turned every other time. Those
// that only lead the strip on are left out.
void addStrip(std::span<const std::int64_t> corners, std::size_t number, Geometry& geometry);

// The corners of a cell among those of all. Throws std::runtime_error where it ends before it begins, or
// behind the last.
std::span<const std::int64_t> cornersOf(std::span<const std::int64_t> all, std::int64_t begin,
                                        std::int64_t end, std::size_t number);

// Adds polygons, or strips, whose corners lie one behind the other; #ends: where each ends.
using AddCell = void (*)(std::span<const std::int64_t>, std::size_t, Geometry&);
void addCells(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends, AddCell add,
              Geometry& geometry);

// "12 points", "1 point"
std::string counted(std::uint64_t count, const std::string& what);

}  // namespace fluidtex::caches
