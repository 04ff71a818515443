#include "sim/shapes/pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::sim {
namespace {

// Rodrigues' formula; the axis has length 1.
Vec3d turned(const Vec3d& x, const Vec3d& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * x + s * axis.cross(x) + (1.0 - c) * axis.dot(x) * axis;
}

// Which file of the sequence is the last one at time t, and how far it is from there to the next.
void setFile(Pose& pose, const MeshSequence& sequence, double t) {
  const int last = sequence.count() - 1;
  const double files = std::clamp((t - sequence.start) * sequence.frameRate, 0.0, double(last));
  // Rounding must not put a file's own time before it.
  int file = static_cast<int>(files);
  if (file < last && sequence.timeOf(file + 1) <= t) ++file;
  if (file > 0 && sequence.timeOf(file) > t) --file;
  pose.file = file;
  if (file == last || sequence.timeOf(file) > t) return;
  pose.part = std::min((t - sequence.timeOf(file)) * sequence.frameRate, 1.0);
  pose.fileRate = sequence.frameRate;
}

}  // namespace

Vec3d Pose::toWorld(const Vec3d& x) const {
  return (angle == 0.0 ? x : pivot + turned(x - pivot, axis, angle)) + move;
}

Vec3d Pose::toBody(const Vec3d& x) const {
  const Vec3d back = x - move;
  return angle == 0.0 ? back : pivot + turned(back - pivot, axis, -angle);
}

Vec3d Pose::directionToWorld(const Vec3d& v) const {
  return angle == 0.0 ? v : turned(v, axis, angle);
}

Vec3d Pose::velocityAt(const Vec3d& x) const {
  return speed + spin * axis.cross(x - pivot - move);
}

Pose poseAt(const Solid& solid, double t) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  Pose pose;
  pose.pivot = solid.pivot;
  pose.axis = solid.axis.unit();
  if (const auto* sequence = std::get_if<MeshSequence>(&solid.shape.kind)) setFile(pose, *sequence, t);
  const auto& keys = solid.keyframes;
  if (keys.empty()) return pose;
  std::size_t next = 0;
  while (next < keys.size() && keys[next].time <= t) ++next;
  const Keyframe& last = keys[next > 0 ? next - 1 : 0];
  pose.move = last.move;
  pose.angle = last.turn * kDegree;
  if (next == 0 || next == keys.size()) return pose;
  const double length = keys[next].time - last.time;
  pose.speed = (keys[next].move - last.move) / length;
  pose.spin = (keys[next].turn - last.turn) * kDegree / length;
  pose.move += (t - last.time) * pose.speed;
  pose.angle += (t - last.time) * pose.spin;
  return pose;
}

openvdb::math::BBox<Vec3d> reachOf(const Solid& solid, const openvdb::math::BBox<Vec3d>& box) {
  if (solid.keyframes.empty()) return box;
  // Between keyframes it moves in straight lines, so the keyframes are the extremes.
  Vec3d least(kForever), most(-kForever);
  bool turns = false;
  for (const Keyframe& key : solid.keyframes) {
    least = openvdb::math::minComponent(least, key.move);
    most = openvdb::math::maxComponent(most, key.move);
    turns = turns || key.turn != 0.0;
  }
  const openvdb::math::BBox<Vec3d> moved(box.min() - most, box.max() - least);
  if (!turns) return moved;
  Vec3d far(0.0);
  for (int a = 0; a < 3; ++a)
    far[a] = std::max(std::abs(moved.min()[a] - solid.pivot[a]), std::abs(moved.max()[a] - solid.pivot[a]));
  return {solid.pivot - Vec3d(far.length()), solid.pivot + Vec3d(far.length())};
}

openvdb::math::BBox<Vec3d> boundsAt(const openvdb::math::BBox<Vec3d>& bounds, const Pose& pose) {
  const Vec3d &low = bounds.min(), &high = bounds.max();
  if (bounds.empty()) return bounds;
  if (pose.angle == 0.0) return {low + pose.move, high + pose.move};
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(low[a]) || !std::isfinite(high[a])) return {Vec3d(-kForever), Vec3d(kForever)};
  }
  openvdb::math::BBox<Vec3d> moved;
  for (int n = 0; n < 8; ++n) {
    const auto pick = [&](int a) { return (n >> a & 1) != 0 ? high[a] : low[a]; };
    moved.expand(pose.toWorld(Vec3d(pick(0), pick(1), pick(2))));
  }
  return moved;
}

}  // namespace fluidtex::sim
