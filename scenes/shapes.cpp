#include "scenes/schema.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::scenes {

namespace {

constexpr Limits kFileNumber{.low = 0.0, .high = 999999.0};

// The shape as the kind asked for, with that kind's defaults if it was another.
template <class Kind>
Kind& as(sim::Shape& shape) {
  if (!std::holds_alternative<Kind>(shape.kind)) shape.kind = Kind{};
  return std::get<Kind>(shape.kind);
}

void describeParts(Visitor& visitor, const std::string& key, std::vector<sim::Shape>& parts) {
  visitor.list(
      key, parts, [&](sim::Shape& part) { describeShape(visitor, part); }, Need::required);
}

bool overlaps(const sim::Box& box, const Vec3d& size) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.max[axis] <= 0.0 || box.min[axis] >= size[axis]) return false;
  }
  return true;
}

bool overlaps(const sim::Sphere& sphere, const Vec3d& size) {
  Vec3d nearest = sphere.center;
  for (int axis = 0; axis < 3; ++axis) nearest[axis] = std::clamp(nearest[axis], 0.0, size[axis]);
  return (sphere.center - nearest).length() < sphere.radius;
}

// Its box, somewhat too large where it lies askew.
bool overlaps(const sim::Cylinder& cylinder, const Vec3d& size) {
  sim::Box box{cylinder.from, cylinder.to};
  const Vec3d along = (cylinder.to - cylinder.from).unit();
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = cylinder.radius * std::sqrt(std::max(0.0, 1.0 - along[axis] * along[axis]));
    if (box.min[axis] > box.max[axis]) std::swap(box.min[axis], box.max[axis]);
    box.min[axis] -= reach;
    box.max[axis] += reach;
  }
  return overlaps(box, size);
}

bool overlaps(const sim::HeightField& ground, const Vec3d&) {
  return std::max(ground.low, ground.high) + ground.translate.z() > 0.0;
}

bool overlaps(const sim::HalfSpace& space, const Vec3d& size) {
  Vec3d deepest;  // the domain's corner furthest behind the plane
  for (int axis = 0; axis < 3; ++axis) deepest[axis] = space.normal[axis] > 0.0 ? 0.0 : size[axis];
  return (deepest - space.point).dot(space.normal) < 0.0;
}

bool overlaps(const sim::MeshShape&, const Vec3d&) {
  return true;
}

bool overlaps(const sim::MeshSequence&, const Vec3d&) {
  return true;
}

bool overlaps(const sim::Union& shape, const Vec3d& size) {
  return std::any_of(shape.parts.begin(), shape.parts.end(),
                     [&](const sim::Shape& part) { return reachesDomain(part, size); });
}

bool overlaps(const sim::Difference& shape, const Vec3d& size) {
  return !shape.parts.empty() && reachesDomain(shape.parts.front(), size);
}

}  // namespace

void describeShape(Visitor& visitor, sim::Shape& shape) {
  const int kind = visitor.alternative(int(shape.kind.index()), kShapeKeys, Need::required);
  if (kind < 0) return;
  const std::string& key = kShapeKeys[std::size_t(kind)];
  if (key == "box") {
    auto& box = as<sim::Box>(shape);
    visitor.table(key, [&] {
      visitor.vector("min", box.min, kAny, Need::required);
      visitor.vector("max", box.max, kAny, Need::required);
    });
  } else if (key == "sphere") {
    auto& sphere = as<sim::Sphere>(shape);
    visitor.table(key, [&] {
      visitor.vector("center", sphere.center, kAny, Need::required);
      visitor.number("radius", sphere.radius, kPositive, Need::required);
    });
  } else if (key == "cylinder") {
    auto& cylinder = as<sim::Cylinder>(shape);
    visitor.table(key, [&] {
      visitor.vector("from", cylinder.from, kAny, Need::required);
      visitor.vector("to", cylinder.to, kAny, Need::required);
      visitor.number("radius", cylinder.radius, kPositive, Need::required);
    });
  } else if (key == "half_space") {
    auto& space = as<sim::HalfSpace>(shape);
    visitor.table(key, [&] {
      visitor.vector("point", space.point, kAny, Need::required);
      visitor.vector("normal", space.normal, kAny, Need::required);
    });
  } else if (key == "mesh") {
    auto& mesh = as<sim::MeshShape>(shape);
    visitor.table(key, [&] {
      visitor.file("file", mesh.file, {".obj", ".ply", ".stl"});
      visitor.number("scale", mesh.scale, kPositive);
      visitor.vector("translate", mesh.translate, kAny);
    });
  } else if (key == "mesh_sequence") {
    auto& sequence = as<sim::MeshSequence>(shape);
    visitor.table(key, [&] {
      visitor.files("files", sequence.files, {".obj", ".ply", ".stl"});
      visitor.integer("first", sequence.first, kFileNumber);
      visitor.integer("last", sequence.last, kFileNumber, Need::required);
      visitor.number("frame_rate", sequence.frameRate, {.low = 0.001, .high = 1000.0});
      visitor.number("start", sequence.start, kNotNegative);
      visitor.number("scale", sequence.scale, kPositive);
      visitor.vector("translate", sequence.translate, kAny);
    });
  } else if (key == "height_field") {
    auto& ground = as<sim::HeightField>(shape);
    visitor.table(key, [&] {
      visitor.file("file", ground.file, {});
      visitor.number("pixel", ground.pixel, kPositive, Need::required);
      visitor.number("low", ground.low, kAny);
      visitor.number("high", ground.high, kAny);
      visitor.vector("translate", ground.translate, kAny);
    });
  } else if (key == "union") {
    describeParts(visitor, key, as<sim::Union>(shape).parts);
  } else {
    describeParts(visitor, key, as<sim::Difference>(shape).parts);
  }
}

bool reachesDomain(const sim::Shape& shape, const Vec3d& size) {
  return std::visit([&](const auto& kind) { return overlaps(kind, size); }, shape.kind);
}

}  // namespace fluidtex::scenes
