// Closed-form distances of the simple shapes; meshes and ground through OpenVDB's level set conversion.
#include "sim/shapes/shape_distance.h"

#include "sim/meshes/mesh_distance.h"
#include "sim/meshes/read_mesh.h"
#include "sim/shapes/height_field.h"
#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/read_heights.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>

#include <cmath>
#include <stdexcept>

namespace fluidtex::sim {

namespace {

// Half width of a mesh's level set in voxels; distances beyond are clamped. Larger than the distance from a
// block's middle to its corners plus the narrow band of a solid's distance, so that blocks far from the mesh
// are recognised.
constexpr float kMeshBand = 10.0f;

double boxDistance(const Box& box, const Vec3d& x) {
  double inside = -kForever, outside = 0.0;
  for (int a = 0; a < 3; ++a) {
    const double d = std::max(box.min[a] - x[a], x[a] - box.max[a]);
    inside = std::max(inside, d);
    if (d > 0.0) outside += d * d;
  }
  return outside > 0.0 ? std::sqrt(outside) : inside;
}

double cylinderDistance(const Cylinder& cylinder, const Vec3d& x) {
  const Vec3d along = cylinder.to - cylinder.from;
  const double length = along.length();
  if (!(length > 0.0)) throw std::runtime_error("a cylinder needs two ends that are not the same point");
  const Vec3d from = x - cylinder.from;
  const double height = from.dot(along) / length;
  const double side = (from - (height / length) * along).length() - cylinder.radius;
  const double end = std::max(-height, height - length);
  return side > 0.0 && end > 0.0 ? std::hypot(side, end) : std::max(side, end);
}

Vec3d unitNormal(const HalfSpace& plane) {
  const double length = plane.normal.length();
  if (!(length > 0.0)) throw std::runtime_error("a half-space needs a normal that is not zero");
  return plane.normal / length;
}

}  // namespace

struct ShapeDistance::Node {
  struct Plane {
    Vec3d point, normal;
  };
  // Made within limits, and extended beyond them as it is there.
  struct Ground {
    openvdb::FloatGrid::ConstPtr grid;
    Vec3d low, high;
  };
  struct Any {
    std::vector<Node> parts;
  };
  struct Less {
    std::vector<Node> parts;
  };
  std::variant<Box, Sphere, Cylinder, Plane, MeshDistance, Ground, Any, Less> kind;

  static Node of(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain,
                 const openvdb::BBoxd& reach);
  static Node of(const TriangleMesh& mesh, double voxelSize, const openvdb::BBoxd& reach);
  static Node of(const HeightField& ground, double voxelSize, const openvdb::BBoxd& domain);
  double distance(const Vec3d& x) const;
  openvdb::BBoxd boundsIn(const openvdb::BBoxd& within) const;
};

ShapeDistance::Node ShapeDistance::Node::of(const Shape& shape, double voxelSize,
                                            const openvdb::BBoxd& domain, const openvdb::BBoxd& reach) {
  const auto nodesOf = [&](const std::vector<Shape>& parts) {
    std::vector<Node> nodes;
    nodes.reserve(parts.size());
    for (const Shape& part : parts) nodes.push_back(of(part, voxelSize, domain, reach));
    return nodes;
  };
  if (const auto* box = std::get_if<Box>(&shape.kind)) return {*box};
  if (const auto* sphere = std::get_if<Sphere>(&shape.kind)) return {*sphere};
  if (const auto* cylinder = std::get_if<Cylinder>(&shape.kind)) return {*cylinder};
  if (const auto* plane = std::get_if<HalfSpace>(&shape.kind))
    return {Plane{plane->point, unitNormal(*plane)}};
  if (const auto* all = std::get_if<Union>(&shape.kind)) return {Any{nodesOf(all->parts)}};
  if (const auto* less = std::get_if<Difference>(&shape.kind)) return {Less{nodesOf(less->parts)}};
  const auto ofFile = [&](const std::filesystem::path& file, const TriangleMesh& mesh) {
    try {
      return of(mesh, voxelSize, reach);
    } catch (const std::runtime_error& error) {
      throw MeshError(file.string() + ": " + error.what());
    }
  };
  if (const auto* sequence = std::get_if<MeshSequence>(&shape.kind))
    return ofFile(sequence->fileOf(0), MovingMesh(*sequence, 0, 0).at(0, 0.0));
  if (const auto* mesh = std::get_if<MeshShape>(&shape.kind)) return ofFile(mesh->file, readMesh(*mesh));
  return of(std::get<HeightField>(shape.kind), voxelSize, domain);
}

ShapeDistance::Node ShapeDistance::Node::of(const HeightField& ground, double voxelSize,
                                            const openvdb::BBoxd& domain) {
  const double band = kMeshBand * voxelSize, beyond = 2.0 * band;
  const TriangleMesh mesh = groundMesh(ground, domain, voxelSize, beyond, -beyond);
  openvdb::BBoxd box;
  for (const openvdb::Vec3f& x : mesh.positions) box.expand(Vec3d(x));
  if (mesh.triangles.empty()) return of(mesh, voxelSize, domain);
  try {
    checkCells(mesh, box.extents(), voxelSize, kMeshBand);
  } catch (const std::runtime_error& error) {
    throw HeightError(ground.file.string() + ": as ground " + error.what());
  }
  Vec3d low(-kForever), high(kForever);
  for (int a = 0; a < 2; ++a) {
    if (!std::isfinite(domain.min()[a]) || box.min()[a] < domain.min()[a] - band)
      low[a] = box.min()[a] + band;
    if (!std::isfinite(domain.max()[a]) || box.max()[a] > domain.max()[a] + band)
      high[a] = box.max()[a] - band;
  }
  low[2] = box.min()[2] + band;
  const auto transform = openvdb::math::Transform::createLinearTransform(voxelSize);
  openvdb::FloatGrid::ConstPtr grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(
      *transform, mesh.positions, mesh.triangles, kMeshBand);
  return {Ground{std::move(grid), low, high}};
}

ShapeDistance::Node ShapeDistance::Node::of(const TriangleMesh& mesh, double voxelSize,
                                            const openvdb::BBoxd& reach) {
  return {meshDistanceIn(reach, mesh, voxelSize, kMeshBand)};
}

double ShapeDistance::Node::distance(const Vec3d& x) const {
  struct Visitor {
    const Vec3d& x;
    double operator()(const Box& box) const { return boxDistance(box, x); }
    double operator()(const Sphere& sphere) const { return (x - sphere.center).length() - sphere.radius; }
    double operator()(const Cylinder& cylinder) const { return cylinderDistance(cylinder, x); }
    double operator()(const Plane& plane) const { return (x - plane.point).dot(plane.normal); }
    double operator()(const MeshDistance& mesh) const { return mesh.at(x); }
    double operator()(const Ground& ground) const {
      Vec3d within = x;
      for (int a = 0; a < 3; ++a) within[a] = std::clamp(x[a], ground.low[a], ground.high[a]);
      return openvdb::tools::BoxSampler::sample(ground.grid->constTree(), ground.grid->worldToIndex(within));
    }
    double operator()(const Any& any) const {
      double nearest = kForever;
      for (const Node& part : any.parts) nearest = std::min(nearest, part.distance(x));
      return nearest;
    }
    double operator()(const Less& less) const {
      double farthest = less.parts.empty() ? kForever : less.parts.front().distance(x);
      for (std::size_t i = 1; i < less.parts.size(); ++i)
        farthest = std::max(farthest, -less.parts[i].distance(x));
      return farthest;
    }
  };
  return std::visit(Visitor{x}, kind);
}

openvdb::BBoxd ShapeDistance::Node::boundsIn(const openvdb::BBoxd& within) const {
  using Bounds = openvdb::BBoxd;
  struct Visitor {
    const Bounds& within;

    Bounds operator()(const Box& box) const { return {box.min, box.max}; }
    Bounds operator()(const Sphere& sphere) const {
      return {sphere.center - Vec3d(sphere.radius), sphere.center + Vec3d(sphere.radius)};
    }
    Bounds operator()(const Cylinder& cylinder) const {
      Bounds box;
      for (const Vec3d& end : {cylinder.from, cylinder.to}) {
        box.expand(end - Vec3d(cylinder.radius));
        box.expand(end + Vec3d(cylinder.radius));
      }
      return box;
    }
    // normal . x <= normal . point: along one axis as far as the least of the others' parts lets it.
    Bounds operator()(const Plane& plane) const {
      const Vec3d& n = plane.normal;
      const auto least = [&](int a) {
        return n[a] == 0.0 ? 0.0 : n[a] * (n[a] > 0.0 ? within.min() : within.max())[a];
      };
      Bounds box = within;
      for (int a = 0; a < 3; ++a) {
        const double end = (n.dot(plane.point) - least((a + 1) % 3) - least((a + 2) % 3)) / n[a];
        if (n[a] > 0.0) box.max()[a] = std::min(box.max()[a], end);
        if (n[a] < 0.0) box.min()[a] = std::max(box.min()[a], end);
      }
      return box;
    }
    Bounds operator()(const MeshDistance& mesh) const { return mesh.bounds; }
    Bounds operator()(const Ground& ground) const {
      Bounds box = ground.grid->transform().indexToWorld(ground.grid->evalActiveVoxelBoundingBox());
      for (int a = 0; a < 3; ++a) {
        if (std::isfinite(ground.low[a])) box.min()[a] = -kForever;
        if (std::isfinite(ground.high[a])) box.max()[a] = kForever;
      }
      return box;
    }
    Bounds operator()(const Any& any) const {
      Bounds box;
      for (const Node& part : any.parts) {
        const Bounds bounds = part.boundsIn(within);
        if (!bounds.empty()) box.expand(bounds);
      }
      return box;
    }
    Bounds operator()(const Less& less) const {
      return less.parts.empty() ? Bounds() : less.parts.front().boundsIn(within);
    }
  };
  Bounds bounds = std::visit(Visitor{within}, kind);
  if (bounds.empty() || !bounds.hasOverlap(within)) return {};
  bounds.min() = openvdb::math::maxComponent(bounds.min(), within.min());
  bounds.max() = openvdb::math::minComponent(bounds.max(), within.max());
  return bounds;
}

openvdb::BBoxd ShapeDistance::boundsIn(const openvdb::BBoxd& box) const {
  return m_root->boundsIn(box);
}

ShapeDistance::ShapeDistance(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain)
    : ShapeDistance(shape, voxelSize, domain, domain) {}

ShapeDistance::ShapeDistance(const Shape& shape, double voxelSize, const openvdb::BBoxd& domain,
                             const openvdb::BBoxd& reach)
    : m_root(std::make_shared<Node>(Node::of(shape, voxelSize, domain, reach))) {}

ShapeDistance::ShapeDistance(const TriangleMesh& mesh, double voxelSize, const openvdb::BBoxd& reach)
    : m_root(std::make_shared<Node>(Node::of(mesh, voxelSize, reach))) {}

double ShapeDistance::operator()(const Vec3d& x) const {
  return m_root->distance(x);
}

}  // namespace fluidtex::sim
