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

bool overlaps(const sim::Box& box, const sim::Box& domain) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.max[axis] <= domain.min[axis] || box.min[axis] >= domain.max[axis]) return false;
  }
  return true;
}

bool overlaps(const sim::Sphere& sphere, const sim::Box& domain) {
  Vec3d nearest = sphere.center;
  for (int axis = 0; axis < 3; ++axis)
    nearest[axis] = std::clamp(nearest[axis], domain.min[axis], domain.max[axis]);
  return (sphere.center - nearest).length() < sphere.radius;
}

// Its box, somewhat too large where it lies askew.
bool overlaps(const sim::Cylinder& cylinder, const sim::Box& domain) {
  sim::Box box{cylinder.from, cylinder.to};
  const Vec3d along = (cylinder.to - cylinder.from).unit();
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = cylinder.radius * std::sqrt(std::max(0.0, 1.0 - along[axis] * along[axis]));
    if (box.min[axis] > box.max[axis]) std::swap(box.min[axis], box.max[axis]);
    box.min[axis] -= reach;
    box.max[axis] += reach;
  }
  return overlaps(box, domain);
}

bool overlaps(const sim::HeightField& ground, const sim::Box& domain) {
  return std::max(ground.low, ground.high) + ground.translate.z() > domain.min.z();
}

bool overlaps(const sim::HalfSpace& space, const sim::Box& domain) {
  Vec3d deepest;  // the domain's corner furthest behind the plane
  for (int axis = 0; axis < 3; ++axis) {
    const double n = space.normal[axis];
    deepest[axis] = n > 0.0 ? domain.min[axis] : n < 0.0 ? domain.max[axis] : space.point[axis];
  }
  return (deepest - space.point).dot(space.normal) < 0.0;
}

bool overlaps(const sim::MeshShape&, const sim::Box&) {
  return true;
}

bool overlaps(const sim::MeshSequence&, const sim::Box&) {
  return true;
}

bool overlaps(const sim::Union& shape, const sim::Box& domain) {
  return std::any_of(shape.parts.begin(), shape.parts.end(),
                     [&](const sim::Shape& part) { return reachesDomain(part, domain); });
}

bool overlaps(const sim::Difference& shape, const sim::Box& domain) {
  return !shape.parts.empty() && reachesDomain(shape.parts.front(), domain);
}

}  // namespace

void describePlace(Visitor& visitor, sim::MeshPlace& place) {
  choice(visitor, "up", place.up, {"z", "y"});
  visitor.vector("rotate", place.rotate, {.low = -360.0, .high = 360.0});
  visitor.number("scale", place.scale, kPositive);
  visitor.vector("translate", place.translate, kAny);
}

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
      describePlace(visitor, mesh.place);
    });
  } else if (key == "mesh_sequence") {
    auto& sequence = as<sim::MeshSequence>(shape);
    visitor.table(key, [&] {
      visitor.files("files", sequence.files, {".obj", ".ply", ".stl"});
      visitor.integer("first", sequence.first, kFileNumber);
      visitor.integer("last", sequence.last, kFileNumber, Need::required);
      visitor.number("frame_rate", sequence.frameRate, {.low = 0.001, .high = 1000.0});
      visitor.number("start", sequence.start, kNotNegative);
      describePlace(visitor, sequence.place);
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

sim::Box domainOf(const sim::Options& options) {
  sim::Box domain{Vec3d(0.0), options.size};
  for (int axis = 0; axis < 3; ++axis) {
    if (options.sides[2 * axis] == sim::Side::unbounded) domain.min[axis] = -sim::kForever;
    if (options.sides[2 * axis + 1] == sim::Side::unbounded) domain.max[axis] = sim::kForever;
  }
  return domain;
}

bool reachesDomain(const sim::Shape& shape, const sim::Box& domain) {
  return std::visit([&](const auto& kind) { return overlaps(kind, domain); }, shape.kind);
}

bool endsInDomain(const sim::Shape& shape, const sim::Box& domain) {
  const auto endless = [&](int side) {
    return !std::isfinite(side % 2 == 0 ? domain.min[side / 2] : domain.max[side / 2]);
  };
  if (const auto* both = std::get_if<sim::Union>(&shape.kind))
    return std::all_of(both->parts.begin(), both->parts.end(),
                       [&](const sim::Shape& part) { return endsInDomain(part, domain); });
  if (const auto* rest = std::get_if<sim::Difference>(&shape.kind))
    return rest->parts.empty() || endsInDomain(rest->parts.front(), domain);
  if (const auto* space = std::get_if<sim::HalfSpace>(&shape.kind)) {
    for (int side = 0; side < 6; ++side) {
      const double outward = space->normal[side / 2] * (side % 2 == 0 ? -1.0 : 1.0);
      if (endless(side) && outward <= 0.0) return false;
    }
  }
  if (std::holds_alternative<sim::HeightField>(shape.kind)) {
    for (int side = 0; side < 5; ++side)  // all but upwards
      if (endless(side)) return false;
  }
  return true;
}

}  // namespace fluidtex::scenes
