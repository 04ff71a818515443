#include "caches/formats/build_geometry.h"

#include "sim/meshes/cut_polygon.h"
#include "sim/meshes/text_scan.h"

#include <cstring>
#include <numeric>
#include <stdexcept>

namespace fluidtex::caches {

namespace {

using openvdb::Index32;
using openvdb::Vec3I;

void checkCorners(std::span<const std::int64_t> corners, std::size_t number, const char* kind,
                  const Geometry& geometry) {
  for (const std::int64_t corner : corners) {
    if (static_cast<std::uint64_t>(corner) < geometry.points.size()) continue;
    throw std::runtime_error(std::string(kind) + " " + std::to_string(number + 1) + " has point " +
                             std::to_string(corner) + ", counted from 0, for a corner, but there are " +
                             counted(geometry.points.size(), "point"));
  }
}

Vec3I triangleOf(std::int64_t a, std::int64_t b, std::int64_t c) {
  return Vec3I(static_cast<Index32>(a), static_cast<Index32>(b), static_cast<Index32>(c));
}

}  // namespace

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void addPoints(std::span<const float> coordinates, Geometry& geometry) {
  const std::size_t before = geometry.points.size(), count = coordinates.size() / 3;
  geometry.points.resize(before + count);
  if (count > 0)
    std::memcpy(static_cast<void*>(&geometry.points[before]), coordinates.data(),
                count * sizeof(openvdb::Vec3f));
}

void addAttribute(const std::string& name, std::uint64_t components, std::vector<float> values,
                  Geometry& geometry) {
  constexpr std::uint64_t kMost = 1 << 20;
  if (components < 1 || components > kMost || values.size() % components != 0 ||
      values.size() / components != geometry.points.size())
    throw std::runtime_error("its array " + sim::inQuotes(name) + " has " + counted(values.size(), "value") +
                             " in rows of " + std::to_string(components) + " for " +
                             counted(geometry.points.size(), "point") + "; one row is needed for each");
  geometry.attributes[name] = {static_cast<int>(components), std::move(values)};
}

void addPolygon(std::span<const std::int64_t> corners, std::size_t number, Geometry& geometry) {
  checkCorners(corners, number, "polygon", geometry);
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    geometry.triangles.push_back(triangleOf(corners[0], corners[1], corners[2]));
    return;
  }
  std::vector<sim::Vec3d> places;
  places.reserve(corners.size());
  for (const std::int64_t corner : corners) places.emplace_back(geometry.points[std::size_t(corner)]);
  std::vector<std::size_t> order(corners.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const auto& [a, b, c] : sim::cutPolygon(places, order))
    geometry.triangles.push_back(triangleOf(corners[a], corners[b], corners[c]));
}

void addStrip(std::span<const std::int64_t> corners, std::size_t number, Geometry& geometry) {
  checkCorners(corners, number, "strip", geometry);
  for (std::size_t n = 2; n < corners.size(); ++n) {
    const std::int64_t a = corners[n - 2], b = corners[n - 1], c = corners[n];
    if (a == b || b == c || c == a) continue;
    geometry.triangles.push_back(n % 2 == 0 ? triangleOf(a, b, c) : triangleOf(b, a, c));
  }
}

std::span<const std::int64_t> cornersOf(std::span<const std::int64_t> all, std::int64_t begin,
                                        std::int64_t end, std::size_t number) {
  if (begin < 0 || end < begin || static_cast<std::uint64_t>(end) > all.size())
    throw std::runtime_error("cell " + std::to_string(number + 1) + " takes corners " +
                             std::to_string(begin) + " to " + std::to_string(end) + " of " +
                             std::to_string(all.size()) +
                             "; offsets rise from cell to cell and end with the corners");
  return all.subspan(std::size_t(begin), std::size_t(end - begin));
}

void addCells(std::span<const std::int64_t> corners, std::span<const std::int64_t> ends, AddCell add,
              Geometry& geometry) {
  std::int64_t begin = 0;
  for (std::size_t n = 0; n < ends.size(); ++n) {
    add(cornersOf(corners, begin, ends[n], n), n, geometry);
    begin = ends[n];
  }
}

}  // namespace fluidtex::caches
