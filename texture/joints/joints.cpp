#include "texture/joints/joints.h"

#include "texture/loops/parallel.h"

#include <algorithm>

namespace fluidtex::texture {
namespace {

// What is known of one kind of place, shown or former.
struct Layer {
  const Torus& torus;
  const std::vector<Vec3f>& positions;
  const Places& places;
  bool joined(std::uint32_t a, std::uint32_t b) const { return onePiece(torus, positions, places, a, b); }
};

// Whether the corners' coordinates, brought onto the exemplar, cannot be interpolated.
bool jumps(const Layer& layer, const Vec3I& corner) {
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
    if (!layer.joined(a, b)) return true;
    const Vec2f from = layer.torus.brought(layer.places.coordinate[a]),
                to = layer.torus.brought(layer.places.coordinate[b]);
    if (layer.torus.unwrapped(to, from) != to) return true;
  }
  return false;
}

CornerPlaces cornerPlaces(const Layer& layer, const Vec3I& corner) {
  CornerPlaces result;
  for (int label = 0; label < 3; ++label) {
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t a = corner[label], b = corner[c];
      const Vec2f own = layer.torus.brought(layer.places.coordinate[a]);
      const Vec2f there = continued(own, layer.places.gradient[a], layer.positions[b] - layer.positions[a]);
      result[std::size_t(label)][std::size_t(c)] =
          a == b || layer.joined(a, b) ? layer.torus.unwrapped(layer.places.coordinate[b], there) : there;
    }
  }
  return result;
}

}  // namespace

Joints findJoints(const TexturedSurface& surface, bool toroidal) {
  if (surface.coordinate.size() != surface.positions.size()) return {};
  Joints result;
  result.former = formerPlaces(surface);
  const Torus torus(surface, toroidal);
  for (Vec2f& former : result.former.places.coordinate) former = torus.brought(former);
  const Places present{surface.coordinate, surface.gradient};
  const Layer shown{torus, surface.positions, present},
      former{torus, surface.positions, result.former.places};
  const auto fades = [&](std::uint32_t v) {
    return !surface.fading.weight.empty() && surface.fading.weight[v] > 0.0f;
  };
  result.joints = gathered<Joint>(surface.triangles.size(), [&](std::uint32_t t, std::vector<Joint>& list) {
    const Vec3I& corner = surface.triangles[t];
    const bool fading = fades(corner[0]) || fades(corner[1]) || fades(corner[2]);
    if (!jumps(shown, corner) && !(fading && jumps(former, corner))) return;
    Joint joint{t, cornerPlaces(shown, corner), {}};
    joint.former = fading ? cornerPlaces(former, corner) : joint.shown;
    list.push_back(joint);
  });
  return result;
}

const Joint* jointIn(const Joints& joints, std::uint32_t triangle) {
  const auto found = std::lower_bound(joints.joints.begin(), joints.joints.end(), triangle,
                                      [](const Joint& joint, std::uint32_t t) { return joint.triangle < t; });
  return found != joints.joints.end() && found->triangle == triangle ? &*found : nullptr;
}

}  // namespace fluidtex::texture
