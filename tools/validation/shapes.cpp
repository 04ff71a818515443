#include "tools/validation/shapes.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

// Distance to the segment from a to b in the plane.
double toSegment(double x, double y, double ax, double ay, double bx, double by) {
  const double dx = bx - ax, dy = by - ay;
  const double t = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - ax - t * dx, y - ay - t * dy);
}

// A disk of radius r around the origin with a slot |x| < w, y < top; exact everywhere.
double slotted(double x, double y, double r, double w, double top) {
  const double rim = -std::sqrt(r * r - w * w);  // where the slot's sides meet the circle
  const double fromCentre = std::hypot(x, y);
  const bool inSlot = std::abs(x) < w && y < top;
  const bool inside = fromCentre < r && !inSlot;
  double nearest = std::min(toSegment(x, y, -w, rim, -w, top), toSegment(x, y, w, rim, w, top));
  nearest = std::min(nearest, toSegment(x, y, -w, top, w, top));
  // The nearest point of the circle counts where it is not in the slot; else the rim's two corners do, which
  // are ends of the sides.
  const bool arc = fromCentre > 0.0 && !(std::abs(x) * r < w * fromCentre && y < 0.0);
  if (arc) nearest = std::min(nearest, std::abs(fromCentre - r));
  return inside ? -nearest : nearest;
}

}  // namespace

Distance circle(double x, double y, double radius) {
  return [=](const Vec3d& p) { return std::hypot(p[0] - x, p[1] - y) - radius; };
}

Distance sphere(const Vec3d& center, double radius) {
  return [=](const Vec3d& p) { return (p - center).length() - radius; };
}

Distance slottedDisk() {
  return [](const Vec3d& p) { return slotted(p[0] - 0.5, p[1] - 0.75, 0.15, 0.025, 0.10); };
}

Distance slottedSphere() {
  return [](const Vec3d& p) {
    // The slot's floor lies 0.125 above the sphere's lowest point.
    const double x = p[0] - 0.5, y = p[1] - 0.75, z = p[2] - 0.5;
    const double ball = std::sqrt(x * x + y * y + z * z) - 0.15;
    const double side = std::abs(x) - 0.025, above = y - (-0.15 + 0.125);
    const double slot =
        std::hypot(std::max(side, 0.0), std::max(above, 0.0)) + std::min(0.0, std::max(side, above));
    return std::max(ball, -slot);
  };
}

}  // namespace fluidtex::validation
