// Reading of mesh files, and their repair into a solid: duplicate points joined (of STL, of split normals),
// walls within removed, polygons split into triangles, all turned outward.
#include "sim/meshes/read_mesh.h"

#include "sim/meshes/closed_surface.h"
#include "sim/meshes/cut_polygon.h"
#include "sim/meshes/mesh_formats.h"
#include "sim/meshes/text_scan.h"
#include "sim/meshes/turned_outward.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <sstream>

namespace fluidtex::sim {

namespace {

using openvdb::Vec3f;
using openvdb::Vec3I;
using Polygon = std::vector<std::size_t>;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw MeshError(file.string() + ": " + what);
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string content(static_cast<std::size_t>(std::filesystem::file_size(file)), '\0');
  in.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (!in) fail(file, "cannot be opened or read");
  return content;
}

// For each point the first one at the same place.
std::vector<std::size_t> joined(const std::vector<Vec3f>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (points[a] != points[b]) return points[a] < points[b];
    return a < b;
  });
  std::vector<std::size_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::string edges(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " edge" : " edges");
}

// uv: takes what an OBJ has of it, where it is given.
MeshSoup soupIn(const std::filesystem::path& file, SoupUv* uv) {
  if (!std::filesystem::exists(file)) fail(file, "no such file");
  if (!std::filesystem::is_regular_file(file)) fail(file, "not a file");
  const std::string extension = inLowerCase(file.extension().string());
  if (extension != ".obj" && extension != ".ply" && extension != ".stl") {
    fail(file, "unknown kind of mesh file '" + extension + "'; expected .obj, .ply or .stl");
  }
  if (uv != nullptr && extension != ".obj")
    fail(file, "texture coordinates are read of .obj alone; export the mesh as that");
  const std::string content = contentOf(file);
  if (content.empty()) fail(file, "the file is empty");
  try {
    return extension == ".obj"   ? soupOfObj(content, uv)
           : extension == ".ply" ? soupOfPly(content)
                                 : soupOfStl(content);
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
}

// Throws MeshError where there are no faces, a vertex is not finite, or a face's corner does not exist.
MeshSoup checked(const std::filesystem::path& file, MeshSoup soup) {
  if (soup.polygons.empty())
    fail(file, soup.points.empty() ? "has no vertices and no faces" : "has no faces");
  for (std::size_t n = 0; n < soup.points.size(); ++n) {
    const Vec3d& p = soup.points[n];
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      fail(file, "vertex " + std::to_string(n + 1) + " is not at finite numbers");
  }
  for (std::size_t n = 0; n < soup.polygons.size(); ++n) {
    for (const std::size_t vertex : soup.polygons[n]) {
      if (vertex >= soup.points.size())
        fail(file, "face " + std::to_string(n + 1) + " names vertex " + std::to_string(vertex) +
                       ", counted from 0, but there are " + std::to_string(soup.points.size()));
    }
  }
  return soup;
}

}  // namespace

void checkClosed(const std::filesystem::path& file, const std::vector<Polygon>& polygons) {
  const OpenEdges open = openEdges(polygons);
  if (open.none()) return;
  std::string what = "is not closed: ";
  if (open.ofOne > 0)
    what += edges(open.ofOne) + (open.ofOne == 1 ? " has" : " have") + " a face on one side only";
  if (open.ofOne > 0 && open.ofMore > 0) what += ", and ";
  if (open.ofMore > 0)
    what += "at " + edges(open.ofMore) +
            " three faces meet, or another odd number: a wall of one face ends there";
  what +=
      "; close it, in Blender with Mesh > Clean Up > Fill Holes, or give a sheet thickness with a Solidify "
      "modifier";
  fail(file, what);
}

std::vector<Vec3I> outwardTriangles(const std::filesystem::path& file, const TriangleMesh& mesh) {
  std::optional<std::vector<Vec3I>> triangles = turnedOutward(mesh);
  if (!triangles)
    fail(file,
         "has no inside: its faces cannot all be turned to one side (a surface that passes through itself)");
  return std::move(*triangles);
}

std::vector<Vec3f> placedPoints(const std::filesystem::path& file, const MeshSoup& soup,
                                const MeshPlace& place) {
  const openvdb::Mat3d rotation = rotationOf(place.up, place.rotate);
  std::vector<Vec3f> positions;
  positions.reserve(soup.points.size());
  for (const Vec3d& p : soup.points) {
    const Vec3d x = place.scale * rotation.transform(p) + place.translate;
    positions.emplace_back(x);
    // Squares of what is farther away than the universe overflow.
    constexpr double kFarthest = 1e18;
    for (int a = 0; a < 3; ++a) {
      if (std::abs(x[a]) > kFarthest) {
        std::ostringstream text;
        text << "vertex " << positions.size() << " lies " << std::abs(x[a]) << " m away";
        fail(file, text.str());
      }
    }
  }
  return positions;
}

MeshSoup readSoup(const std::filesystem::path& file) {
  return checked(file, soupIn(file, nullptr));
}

MeshSoup readSoup(const std::filesystem::path& file, SoupUv& uv) {
  uv = {};
  return checked(file, soupIn(file, &uv));
}

TriangleMesh readMesh(const MeshShape& shape) {
  const MeshSoup soup = readSoup(shape.file);
  const std::vector<Vec3f> positions = placedPoints(shape.file, soup, shape.place);
  const std::vector<std::size_t> vertexOf = joined(positions);
  std::vector<Polygon> polygons;
  for (Polygon polygon : soup.polygons) {
    for (std::size_t& corner : polygon) corner = vertexOf[corner];
    polygon = withoutRepeats(polygon);
    if (polygon.size() >= 3) polygons.push_back(std::move(polygon));
  }
  if (polygons.empty()) fail(shape.file, "all its faces are degenerate");
  polygons = withoutTwins(polygons);
  checkClosed(shape.file, polygons);

  TriangleMesh mesh;
  constexpr openvdb::Index32 kUnused = std::numeric_limits<openvdb::Index32>::max();
  std::vector<openvdb::Index32> place(positions.size(), kUnused);
  for (const Polygon& polygon : polygons) {
    for (const auto& corners : cutPolygon(soup.points, polygon)) {
      Vec3I triangle;
      for (int c = 0; c < 3; ++c) {
        openvdb::Index32& vertex = place[corners[std::size_t(c)]];
        if (vertex == kUnused) {
          vertex = static_cast<openvdb::Index32>(mesh.positions.size());
          mesh.positions.push_back(positions[corners[std::size_t(c)]]);
        }
        triangle[c] = vertex;
      }
      // Where a polygon touches itself.
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
        mesh.triangles.push_back(triangle);
    }
  }
  mesh.triangles = outwardTriangles(shape.file, mesh);
  return mesh;
}

}  // namespace fluidtex::sim
