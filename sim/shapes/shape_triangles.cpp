// Triangles of shapes for drawing. Boxes and half-spaces are exact (a convex solid cut by planes), spheres
// are divided icosahedra; what is left is meshed from its distance on a grid.
#include "sim/shapes/shape_triangles.h"

#include "sim/grid/mac_grid.h"
#include "sim/meshes/read_mesh.h"
#include "sim/meshes/triangle_mesh.h"
#include "sim/shapes/height_field.h"
#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/pose.h"
#include "sim/shapes/shape_distance.h"

#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace fluidtex::sim {

namespace {

using openvdb::BBoxd;
using Polygon = std::vector<Vec3d>;

// A half-space reaches at most this much of the box's diagonal too little before it counts as missing it.
constexpr double kFlat = 1e-9;

std::vector<Polygon> boxPolygons(const Vec3d& low, const Vec3d& high) {
  std::vector<Polygon> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    Polygon face(4, low);
    face[1][a] = face[2][a] = high[a];
    face[2][b] = face[3][b] = high[b];
    Polygon opposite = face;
    for (Vec3d& x : opposite) x[axis] = high[axis];
    std::reverse(face.begin(), face.end());
    faces.push_back(face);
    faces.push_back(opposite);
  }
  return faces;
}

// The part of a convex solid behind a plane, with the cut closed by one more polygon.
std::vector<Polygon> clip(const std::vector<Polygon>& solid, const Vec3d& point, const Vec3d& normal,
                          double eps) {
  const auto height = [&](const Vec3d& x) {
    const double d = (x - point).dot(normal);
    return std::abs(d) < eps ? 0.0 : d;
  };
  std::vector<Polygon> kept;
  Polygon rim;
  for (const Polygon& face : solid) {
    Polygon part;
    bool behind = false;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec3d &x = face[i], &y = face[(i + 1) % face.size()];
      const double dx = height(x), dy = height(y);
      behind = behind || dx < 0.0;
      if (dx <= 0.0) part.push_back(x);
      if (dx == 0.0) rim.push_back(x);
      if (dx * dy < 0.0) {
        // From the lower end always, so that the two faces of an edge get the very same point.
        const Vec3d cut = dx < dy ? x + (y - x) * (dx / (dx - dy)) : y + (x - y) * (dy / (dy - dx));
        part.push_back(cut);
        rim.push_back(cut);
      }
    }
    if (behind && part.size() >= 3) kept.push_back(part);
  }
  if (kept.size() == solid.size() && std::none_of(solid.begin(), solid.end(), [&](const Polygon& face) {
        return std::any_of(face.begin(), face.end(), [&](const Vec3d& x) { return height(x) > 0.0; });
      })) {
    return solid;
  }
  // Around the rim by angle; points met from several faces are taken once.
  Vec3d middle(0.0);
  for (const Vec3d& x : rim) middle += x / static_cast<double>(rim.size());
  const Vec3d e = std::abs(normal.x()) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d s = normal.cross(e).unit(), t = normal.cross(s);
  const auto angle = [&](const Vec3d& x) { return std::atan2((x - middle).dot(t), (x - middle).dot(s)); };
  std::sort(rim.begin(), rim.end(), [&](const Vec3d& x, const Vec3d& y) { return angle(x) < angle(y); });
  Polygon cap;
  for (const Vec3d& x : rim) {
    if (cap.empty() || (x - cap.back()).length() > eps) cap.push_back(x);
  }
  while (cap.size() > 1 && (cap.front() - cap.back()).length() <= eps) cap.pop_back();
  if (!kept.empty() && cap.size() >= 3) kept.push_back(cap);
  return kept;
}

// Corners that coincide share a vertex; polygons become fans.
TriangleMesh meshOf(const std::vector<Polygon>& polygons, double eps) {
  TriangleMesh mesh;
  std::vector<Vec3d> points;
  const auto vertex = [&](const Vec3d& x) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if ((points[i] - x).length() <= eps) return static_cast<openvdb::Index32>(i);
    }
    points.push_back(x);
    mesh.positions.emplace_back(x);
    return static_cast<openvdb::Index32>(points.size() - 1);
  };
  for (const Polygon& polygon : polygons) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const openvdb::Vec3I t(vertex(polygon[0]), vertex(polygon[i]), vertex(polygon[i + 1]));
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

TriangleMesh icosphere(const Sphere& sphere, double voxelSize) {
  const double g = std::numbers::phi;
  std::vector<Vec3d> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<openvdb::Vec3I> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                        {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                        {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                        {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (Vec3d& p : points) p.normalize();
  // Edges no longer than a voxel, between 1,280 and 82,000 triangles.
  const double firstEdge = 1.05 * sphere.radius;
  const int levels = static_cast<int>(std::clamp(std::ceil(std::log2(firstEdge / voxelSize)), 3.0, 6.0));
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<openvdb::Index32, openvdb::Index32>, openvdb::Index32> middles;
    const auto middle = [&](openvdb::Index32 a, openvdb::Index32 b) {
      const auto [at, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<openvdb::Index32>(points.size()));
      if (isNew) points.push_back((points[a] + points[b]).unit());
      return at->second;
    };
    std::vector<openvdb::Vec3I> finer;
    for (const openvdb::Vec3I& t : triangles) {
      const openvdb::Index32 a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    triangles = std::move(finer);
  }
  TriangleMesh mesh;
  for (const Vec3d& p : points) mesh.positions.emplace_back(sphere.center + sphere.radius * p);
  mesh.triangles = std::move(triangles);
  return mesh;
}

// The surface of a shape within the box, from its distance at the corners of voxels.
TriangleMesh meshDistance(const ShapeDistance& distance, const BBoxd& within, double h) {
  const ShapeDistance box(Shape{Box{within.min(), within.max()}}, h);
  const float band = static_cast<float>(3.0 * h);
  auto grid = openvdb::FloatGrid::create(band);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(h));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  const BBoxd room = distance.boundsIn(within);
  if (room.empty()) return {};
  const Coord first = cellsIn(room, h).min(), cells = cellCount(room.extents(), h);
  const Coord n((cells[0] >> 3) + 3, (cells[1] >> 3) + 3, (cells[2] >> 3) + 3);
  const int count = n[0] * n[1] * n[2];
  const double radius = (0.5 * std::sqrt(3.0) * kLeafDim + 3.0) * h;
  const auto originOf = [&](int b) {
    const Coord block(b / (n[1] * n[2]), b / n[2] % n[1], b % n[2]);
    return ((block + (first >> 3)) << 3).offsetBy(-kLeafDim);
  };
  std::vector<std::unique_ptr<FloatLeaf>> leaves(count);
  std::vector<char> inside(count, 0);
  tbb::parallel_for(tbb::blocked_range<int>(0, count), [&](const tbb::blocked_range<int>& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const auto value = [&](const Coord& c) {
        const Vec3d x(c[0] * h, c[1] * h, c[2] * h);
        return std::max(distance(x), box(x));
      };
      const double middle = value(originOf(b).offsetBy(kLeafDim / 2));
      if (std::abs(middle) > radius) {
        inside[b] = middle < 0.0;
        continue;
      }
      leaves[b] = std::make_unique<FloatLeaf>(originOf(b), band, false);
      for (int c = 0; c < kLeafSize; ++c) {
        const double d = value(leaves[b]->offsetToGlobalCoord(c));
        leaves[b]->setValueOnly(c, std::clamp(static_cast<float>(d), -band, band));
        if (std::abs(d) < band) leaves[b]->setActiveState(c, true);
      }
    }
  });
  for (int b = 0; b < count; ++b) {
    if (leaves[b] != nullptr) {
      grid->tree().addLeaf(leaves[b].release());
    } else if (inside[b]) {
      grid->tree().addTile(1, originOf(b), -band, false);
    }
  }
  TriangleMesh mesh;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*grid, mesh.positions, mesh.triangles, quads, 0.0, 0.0);
  for (const openvdb::Vec4I& q : quads) {
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
  }
  // OpenVDB's faces are clockwise from outside.
  for (openvdb::Vec3I& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

// The ground in the box only, its rim closed down to the floor.
TriangleMesh drawnGround(const HeightField& ground, const BBoxd& within, double h) {
  // As fine as the picture, but no more than the cells can tell.
  const double spacing = std::clamp(ground.pixel, 0.25 * h, h);
  TriangleMesh mesh = groundMesh(ground, within, spacing, 0.0, 0.0);
  for (openvdb::Vec3f& x : mesh.positions) x.z() = std::clamp(x.z(), 0.0f, float(within.max().z()));
  return mesh;
}

TriangleMesh tube(const Cylinder& cylinder, double h) {
  const Vec3d along = (cylinder.to - cylinder.from).unit();
  const Vec3d e = std::abs(along.x()) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d s = along.cross(e).unit(), t = along.cross(s);
  const int n = static_cast<int>(std::clamp(2.0 * std::numbers::pi * cylinder.radius / h, 32.0, 512.0));
  using Index = openvdb::Index32;
  TriangleMesh mesh;
  mesh.positions = {openvdb::Vec3f(cylinder.from), openvdb::Vec3f(cylinder.to)};
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    const Vec3d out = cylinder.radius * (std::cos(angle) * s + std::sin(angle) * t);
    mesh.positions.emplace_back(cylinder.from + out);
    mesh.positions.emplace_back(cylinder.to + out);
  }
  for (int i = 0; i < n; ++i) {
    const Index low = Index(2 + 2 * i), next = Index(2 + 2 * ((i + 1) % n));
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{0, next, low}, {1, low + 1, next + 1}, {low, next, next + 1}, {low, next + 1, low + 1}});
  }
  return mesh;
}

// As it is where it lies within the box.
TriangleMesh clipped(TriangleMesh mesh, const BBoxd& within, double h) {
  const auto inside = [&](const openvdb::Vec3f& x) { return within.isInside(Vec3d(x)); };
  if (std::all_of(mesh.positions.begin(), mesh.positions.end(), inside)) return mesh;
  return meshDistance(ShapeDistance(mesh, h, within), within, h);
}

TriangleMesh meshAt(const MeshSequence& sequence, int file, double part) {
  return MovingMesh(sequence, file, std::min(file + 1, sequence.count() - 1)).at(file, part);
}

// All of a curved shape that has an end, also beyond the box; nothing for others.
TriangleMesh wholeMesh(const Shape& shape, double voxelSize) {
  if (const auto* sphere = std::get_if<Sphere>(&shape.kind)) return icosphere(*sphere, voxelSize);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape.kind)) return tube(*cylinder, voxelSize);
  if (const auto* file = std::get_if<MeshShape>(&shape.kind)) return readMesh(*file);
  return {};
}

TriangleMesh movedBox(const Box& box, const Pose& pose, const BBoxd& within) {
  const double eps = kFlat * within.extents().length();
  std::vector<Polygon> faces = boxPolygons(box.min, box.max);
  for (Polygon& face : faces)
    for (Vec3d& x : face) x = pose.toWorld(x);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d up(0.0);
    up[axis] = 1.0;
    faces = clip(clip(faces, within.min(), -up, eps), within.max(), up, eps);
  }
  return meshOf(faces, eps);
}

void move(TriangleMesh& mesh, const Pose& pose) {
  for (openvdb::Vec3f& x : mesh.positions) x = openvdb::Vec3f(pose.toWorld(Vec3d(x)));
}

}  // namespace

TriangleMesh triangulate(const Shape& shape, const BBoxd& within, double voxelSize) {
  const double eps = kFlat * within.extents().length();
  if (const auto* box = std::get_if<Box>(&shape.kind)) {
    Vec3d low = box->min, high = box->max;
    for (int a = 0; a < 3; ++a) {
      low[a] = std::max(low[a], within.min()[a]);
      high[a] = std::min(high[a], within.max()[a]);
      if (low[a] >= high[a]) return {};
    }
    return meshOf(boxPolygons(low, high), eps);
  }
  if (const auto* plane = std::get_if<HalfSpace>(&shape.kind)) {
    return meshOf(clip(boxPolygons(within.min(), within.max()), plane->point, plane->normal.unit(), eps),
                  eps);
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape.kind)) {
    const Vec3d reach(sphere->radius);
    if (within.isInside(BBoxd(sphere->center - reach, sphere->center + reach)))
      return icosphere(*sphere, voxelSize);
  }
  if (const auto* ground = std::get_if<HeightField>(&shape.kind))
    return drawnGround(*ground, within, voxelSize);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape.kind)) {
    const Vec3d reach(cylinder->radius);
    if (within.isInside(BBoxd(cylinder->from - reach, cylinder->from + reach)) &&
        within.isInside(BBoxd(cylinder->to - reach, cylinder->to + reach)))
      return tube(*cylinder, voxelSize);
  }
  if (const auto* file = std::get_if<MeshShape>(&shape.kind))
    return clipped(readMesh(*file), within, voxelSize);
  if (const auto* sequence = std::get_if<MeshSequence>(&shape.kind))
    return clipped(meshAt(*sequence, 0, 0.0), within, voxelSize);
  return meshDistance(ShapeDistance(shape, voxelSize, within), within, voxelSize);
}

TriangleMesh triangulate(const Solid& solid, double t, const BBoxd& within, double voxelSize) {
  const Pose pose = poseAt(solid, t);
  const bool moves = !solid.keyframes.empty();
  if (const auto* box = std::get_if<Box>(&solid.shape.kind); box != nullptr && moves)
    return movedBox(*box, pose, within);
  const auto* sequence = std::get_if<MeshSequence>(&solid.shape.kind);
  TriangleMesh mesh = sequence != nullptr ? meshAt(*sequence, pose.file, pose.part)
                      : moves             ? wholeMesh(solid.shape, voxelSize)
                                          : TriangleMesh();
  if (mesh.positions.empty()) {
    mesh = triangulate(solid.shape, within, voxelSize);
    if (moves) move(mesh, pose);
    return mesh;
  }
  if (moves) move(mesh, pose);
  return clipped(std::move(mesh), within, voxelSize);
}

}  // namespace fluidtex::sim
