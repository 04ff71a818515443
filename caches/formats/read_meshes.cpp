// OBJ, PLY and STL, whose readers are those of solids' shapes.
#include "caches/formats/build_geometry.h"
#include "caches/formats/geometry_formats.h"
#include "sim/meshes/mesh_formats.h"

#include <array>

namespace fluidtex::caches {

namespace {

Geometry geometryOf(const sim::MeshSoup& soup) {
  Geometry geometry;
  geometry.points.reserve(soup.points.size());
  for (const sim::Vec3d& point : soup.points) geometry.points.emplace_back(point);
  geometry.triangles.reserve(soup.polygons.size());
  std::vector<std::int64_t> corners;
  for (std::size_t n = 0; n < soup.polygons.size(); ++n) {
    corners.assign(soup.polygons[n].begin(), soup.polygons[n].end());
    addPolygon(corners, n, geometry);
  }
  return geometry;
}

// What "vx" is an axis of, or "velocity_x"; empty where it is none.
std::string stemOf(std::string name) {
  if (!name.ends_with('x') && !name.ends_with('X')) return {};
  name.pop_back();
  if (name.ends_with('_') || name.ends_with('.')) name.pop_back();
  return name;
}

void addProperties(std::vector<sim::VertexProperty> properties, Geometry& geometry) {
  std::map<std::string, std::size_t> placeOf;
  for (std::size_t p = 0; p < properties.size(); ++p) placeOf.emplace(properties[p].name, p);
  std::vector<bool> isJoined(properties.size(), false);
  for (std::size_t p = 0; p < properties.size(); ++p) {
    std::string name = properties[p].name;
    const std::string stem = stemOf(name);
    if (stem.empty()) continue;
    std::array<std::size_t, 3> places{p, p, p};
    bool isWhole = true;
    for (const int axis : {1, 2}) {
      ++name.back();
      const auto at = placeOf.find(name);
      isWhole = isWhole && at != placeOf.end() &&
                properties[at->second].values.size() == properties[p].values.size();
      if (isWhole) places[std::size_t(axis)] = at->second;
    }
    if (!isWhole) continue;
    std::vector<float> values;
    values.reserve(3 * properties[p].values.size());
    for (std::size_t n = 0; n < properties[p].values.size(); ++n)
      for (const std::size_t place : places) values.push_back(properties[place].values[n]);
    addAttribute(stem, 3, std::move(values), geometry);
    for (const std::size_t place : places) isJoined[place] = true;
  }
  for (std::size_t p = 0; p < properties.size(); ++p)
    if (!isJoined[p]) {
      // Texture coordinates are often u and v.
      std::string name = properties[p].name;
      while (geometry.attributes.contains(name)) name += "_";
      addAttribute(name, 1, std::move(properties[p].values), geometry);
    }
}

}  // namespace

Geometry geometryOfObj(std::string_view bytes) {
  return geometryOf(sim::soupOfObj(bytes));
}

Geometry geometryOfStl(std::string_view bytes) {
  return geometryOf(sim::soupOfStl(bytes));
}

Geometry geometryOfPly(std::string_view bytes) {
  std::vector<sim::VertexProperty> properties;
  Geometry geometry = geometryOf(sim::soupOfPly(bytes, &properties));
  addProperties(std::move(properties), geometry);
  return geometry;
}

}  // namespace fluidtex::caches
