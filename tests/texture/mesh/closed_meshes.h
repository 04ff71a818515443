// Closed meshes with known geometry, for tests.
#pragma once

#include "texture/surface.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace fluidtex::testing {

using texture::SurfaceMesh;
using texture::Vec3f;
using texture::Vec3I;

inline double triangleArea(const SurfaceMesh& mesh, const Vec3I& t) {
  const openvdb::Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
  return 0.5 * (b - a).cross(c - a).length();
}

// Spacing as design asks for it: side of the square that one vertex stands for.
inline void setSpacing(SurfaceMesh& mesh) {
  double area = 0.0;
  for (const Vec3I& t : mesh.triangles) area += triangleArea(mesh, t);
  mesh.spacing = std::sqrt(area / double(mesh.positions.size()));
}

// An icosahedron, each face split into subdivisions^2 triangles, all vertices on the sphere.
inline SurfaceMesh sphereMesh(int subdivisions, double radius = 1.0,
                              const openvdb::Vec3d& center = {0, 0, 0}) {
  const double g = std::numbers::phi;
  const std::array<openvdb::Vec3d, 12> corner{{{-1, g, 0},
                                               {1, g, 0},
                                               {-1, -g, 0},
                                               {1, -g, 0},
                                               {0, -1, g},
                                               {0, 1, g},
                                               {0, -1, -g},
                                               {0, 1, -g},
                                               {g, 0, -1},
                                               {g, 0, 1},
                                               {-g, 0, -1},
                                               {-g, 0, 1}}};
  constexpr int kFaces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  SurfaceMesh mesh;
  std::map<std::array<long, 3>, std::uint32_t> known;  // corners and edges are shared between faces
  const auto vertex = [&](openvdb::Vec3d p) {
    p.normalize();
    const std::array<long, 3> key{std::lround(p.x() * 1e7), std::lround(p.y() * 1e7),
                                  std::lround(p.z() * 1e7)};
    const auto [it, fresh] = known.try_emplace(key, std::uint32_t(mesh.positions.size()));
    if (fresh) {
      mesh.positions.emplace_back(center + p * radius);
      mesh.normals.emplace_back(p);
    }
    return it->second;
  };
  for (const auto& face : kFaces) {
    const auto at = [&](int i, int j) {
      const double s = double(i) / subdivisions, t = double(j) / subdivisions;
      return vertex(corner[face[0]] * (1 - s - t) + corner[face[1]] * s + corner[face[2]] * t);
    };
    for (int i = 0; i < subdivisions; ++i) {
      for (int j = 0; i + j < subdivisions; ++j) {
        mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 2 <= subdivisions)
          mesh.triangles.emplace_back(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  setSpacing(mesh);
  return mesh;
}

// Around the z axis, `around` x `across` vertices.
inline SurfaceMesh torusMesh(int around, int across, double major = 1.0, double minor = 0.4) {
  SurfaceMesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
      const openvdb::Vec3d n(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b));
      mesh.positions.emplace_back(openvdb::Vec3d(std::cos(a), std::sin(a), 0) * major + n * minor);
      mesh.normals.emplace_back(n);
      const auto at = [&](int k, int l) { return std::uint32_t((k % around) * across + l % across); };
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  setSpacing(mesh);
  return mesh;
}

// A box [lower, upper] with sides split into `cells` squares each; normals are the faces' (on edges and
// corners their mean).
inline SurfaceMesh boxMesh(const openvdb::Vec3d& lower, const openvdb::Vec3d& upper,
                           const openvdb::Vec3i& cells) {
  SurfaceMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& ijk, const Vec3f& normal) {
    const auto [it, fresh] = known.try_emplace(ijk, std::uint32_t(mesh.positions.size()));
    if (fresh) {
      const openvdb::Vec3d share = openvdb::Vec3d(ijk[0], ijk[1], ijk[2]) / openvdb::Vec3d(cells);
      mesh.positions.emplace_back(lower + (upper - lower) * share);
      mesh.normals.emplace_back(0, 0, 0);
    }
    mesh.normals[it->second] += normal;
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const int side : {0, 1}) {
      Vec3f normal(0, 0, 0);
      normal[axis] = side ? 1.0f : -1.0f;
      const auto at = [&](int i, int j) {
        std::array<int, 3> ijk{};
        ijk[axis] = side ? cells[axis] : 0;
        ijk[a] = i;
        ijk[b] = j;
        return vertex(ijk, normal);
      };
      for (int i = 0; i < cells[a]; ++i) {
        for (int j = 0; j < cells[b]; ++j) {
          const std::uint32_t p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
          if (side) {
            mesh.triangles.emplace_back(p, q, r);
            mesh.triangles.emplace_back(p, r, s);
          } else {
            mesh.triangles.emplace_back(p, r, q);
            mesh.triangles.emplace_back(p, s, r);
          }
        }
      }
    }
  }
  for (Vec3f& n : mesh.normals) n.normalize();
  setSpacing(mesh);
  return mesh;
}

// Two meshes as one.
inline SurfaceMesh together(SurfaceMesh a, const SurfaceMesh& b) {
  const auto base = std::uint32_t(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  for (const Vec3I& t : b.triangles) a.triangles.emplace_back(t[0] + base, t[1] + base, t[2] + base);
  return a;
}

struct NamedMesh {
  const char* name;
  SurfaceMesh mesh;
};

// A sphere, a torus and a box.
inline std::vector<NamedMesh> closedMeshes() {
  return {{"sphere", sphereMesh(8)},
          {"torus", torusMesh(40, 20)},
          {"box", boxMesh({0, 0, 0}, {1, 2, 1.5}, {5, 10, 7})}};
}

}  // namespace fluidtex::testing
