#include "render/camera.h"

#include <numbers>
#include <stdexcept>

namespace fluidtex::render {

Vec3f CameraRays::direction(float x, float y) const {
  return normalized(forward + right * (x - center[0]) + down * (y - center[1]));
}

CameraRays::FromLens CameraRays::fromLens(float x, float y, const Vec2f& place) const {
  const Vec3f straight = direction(x, y);
  if (lensRadius <= 0.0f) return {origin, straight};
  const Vec3f sharp = origin + straight * (focus / straight.dot(forward));
  const Vec3f start =
      origin + normalized(right) * (lensRadius * place[0]) + normalized(down) * (lensRadius * place[1]);
  return {start, normalized(sharp - start)};
}

CameraRays makeCamera(const Camera& camera, int width, int height, double progress) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (!(camera.fov > 0.0 && camera.fov < 180.0))
    throw std::invalid_argument("the camera's field of view must lie between 0 and 180 degrees");

  const double angle = camera.turn * progress * kDegree, c = std::cos(angle), s = std::sin(angle);
  const Vec3d arm = camera.from - camera.at;
  const Vec3d turned(c * arm[0] - s * arm[1], s * arm[0] + c * arm[1], arm[2]);
  const double distance = turned.length();
  if (!(distance > 0.0)) throw std::invalid_argument("the camera stands at the point it looks at");

  const Vec3d forward = turned * (-1.0 / distance);
  Vec3d right = forward.cross(Vec3d(0.0, 0.0, 1.0));
  if (right.length() < 1e-9) right = Vec3d(c, s, 0.0);
  right.normalize();
  const Vec3d down = forward.cross(right);
  const double step = 2.0 * std::tan(0.5 * camera.fov * kDegree) / height;

  CameraRays rays;
  rays.origin = Vec3f(camera.at + turned);
  rays.forward = Vec3f(forward);
  rays.right = Vec3f(right * step);
  rays.down = Vec3f(down * step);
  rays.lensRadius = 0.5f * static_cast<float>(camera.aperture);
  rays.focus = static_cast<float>(camera.focus > 0.0 ? camera.focus : distance);
  rays.center = Vec2f(0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height));
  return rays;
}

}  // namespace fluidtex::render
