// Mesh files through CGAL: soup of polygons, repaired (double points of STL and of split normals joined),
// turned outward.
#include "sim/read_mesh.h"

#include "sim/shapes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <map>

namespace fluidtex::sim {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Polygon = std::vector<std::size_t>;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw MeshError(file.string() + ": " + what);
}

// CGAL's PLY reader writes to std::cerr as it gives up; the caller reports the fault instead.
struct QuietErrors {
  const std::ios::iostate before = std::cerr.rdstate();
  QuietErrors() { std::cerr.setstate(std::ios::failbit); }
  ~QuietErrors() { std::cerr.clear(before); }
};

}  // namespace

std::size_t openEdges(const std::vector<Polygon>& polygons) {
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::size_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      ++uses[std::minmax(a, b)];
    }
  }
  return std::count_if(uses.begin(), uses.end(), [](const auto& edge) { return edge.second % 2 != 0; });
}

void failOpen(const std::filesystem::path& file, std::size_t openEdges) {
  fail(file, "is not closed: " + std::to_string(openEdges) + (openEdges == 1 ? " edge has" : " edges have") +
                 " a face on one side only");
}

MeshSoup readSoup(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) fail(file, "no such file");
  if (!std::filesystem::is_regular_file(file)) fail(file, "not a file");
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".obj" && extension != ".ply" && extension != ".stl") {
    fail(file, "unknown kind of mesh file '" + extension + "'; expected .obj, .ply or .stl");
  }
  if (std::filesystem::file_size(file) == 0) fail(file, "the file is empty");

  std::vector<Point> points;
  MeshSoup soup;
  std::vector<Polygon>& polygons = soup.polygons;
  bool read = false;
  try {
    const QuietErrors quiet;
    const std::string name = file.string();
    read = extension == ".obj"   ? CGAL::IO::read_OBJ(name, points, polygons)
           : extension == ".ply" ? CGAL::IO::read_PLY(name, points, polygons)
                                 : CGAL::IO::read_STL(name, points, polygons);
  } catch (const std::exception& error) {
    fail(file, std::string("cannot be read as a mesh: ") + error.what());
  }
  if (!read && !points.empty() && polygons.empty()) fail(file, "has no faces");
  if (!read) fail(file, "cannot be read as a mesh: the file is damaged or of another format");
  if (polygons.empty()) fail(file, "has no faces");
  for (const Point& p : points) {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
      fail(file, "has a vertex that is not a finite number");
    }
    soup.points.emplace_back(p.x(), p.y(), p.z());
  }
  for (const Polygon& polygon : polygons) {
    for (const std::size_t vertex : polygon) {
      if (vertex >= points.size()) fail(file, "a face names a vertex that does not exist");
    }
  }
  return soup;
}

TriangleMesh readMesh(const MeshShape& shape) {
  MeshSoup soup = readSoup(shape.file);
  std::vector<Polygon>& polygons = soup.polygons;
  std::vector<Point> points;
  for (const Vec3d& x : soup.points) points.emplace_back(x.x(), x.y(), x.z());
  PMP::repair_polygon_soup(points, polygons);
  if (polygons.empty()) fail(shape.file, "all its faces are degenerate");
  if (const std::size_t open = openEdges(polygons); open > 0) failOpen(shape.file, open);
  PMP::orient_polygon_soup(points, polygons);
  CGAL::Surface_mesh<Point> surface;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, surface);
  if (!PMP::triangulate_faces(surface)) fail(shape.file, "has a face that cannot be cut into triangles");
  if (CGAL::is_closed(surface)) PMP::orient_to_bound_a_volume(surface);

  TriangleMesh mesh;
  for (const auto vertex : surface.vertices()) {
    const Point& p = surface.point(vertex);
    const Vec3d x = shape.scale * Vec3d(p.x(), p.y(), p.z()) + shape.translate;
    mesh.positions.emplace_back(x);
  }
  const bool mirrored = shape.scale < 0.0;
  for (const auto face : surface.faces()) {
    openvdb::Vec3I triangle;
    int corner = 0;
    for (const auto vertex : CGAL::vertices_around_face(surface.halfedge(face), surface)) {
      triangle[corner++] = static_cast<openvdb::Index32>(vertex.idx());
    }
    if (mirrored) std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

}  // namespace fluidtex::sim
