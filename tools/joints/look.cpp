#include "tools/joints/look.h"

#include "render/embree_scene.h"
#include "texture/exemplar/srgb.h"

#include <tbb/parallel_for.h>

namespace fluidtex::joints {
namespace {

using texture::Vec3f;
using texture::Vec4f;

constexpr int kAcross = 4;  // points of a pixel, along each side
constexpr int kPoints = kAcross * kAcross;

// The weights that a point of a cut triangle has in the triangle that this is a part of.
Vec3f weightsBefore(const texture::TexturedSurface& surface, const texture::CutSurface& cut,
                    const Place& place) {
  const texture::Vec3I &corner = surface.triangles[place.triangle],
                       &part = cut.surface.triangles[place.cutTriangle];
  Vec3f weights(0.0f);
  for (int k = 0; k < 3; ++k) {
    const texture::Origin& origin = cut.origin[part[k]];
    for (std::size_t i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c)
        if (origin.weight[i] > 0.0f && origin.vertex[i] == corner[c])
          weights[c] += place.cutWeights[k] * origin.weight[i];
  }
  return weights;
}

class Looker {
 public:
  Looker(const texture::TexturedSurface& surface, const texture::Joints& joints,
         const texture::CutSurface& cut, bool toroidal, const std::vector<Way>& ways,
         const render::CameraRays& camera)
      : m_surface(surface), m_cut(cut), m_ways(ways), m_camera(camera), m_isJoint(surface.triangles.size()) {
    const texture::Torus torus(surface, toroidal);
    for (const texture::Joint& joint : joints.joints)
      m_isJoint[joint.triangle] = isOfSeveralPieces(joint, torus);
    m_scene.add(cut.surface.positions, cut.surface.triangles);
    m_scene.commit();
  }

  void lookAt(int x, int y, Seen& seen) const {
    std::array<render::Ray, kPoints> rays;
    for (int i = 0; i < kPoints; ++i) {
      const int column = i % kAcross, row = i / kAcross;
      rays[std::size_t(i)] = {m_camera.origin, m_camera.direction(float(x) + (float(column) + 0.5f) / kAcross,
                                                                  float(y) + (float(row) + 0.5f) / kAcross)};
    }
    m_scene.intersect(rays, render::Coherence::alike);
    std::vector<float> luminance(m_ways.size(), 0.0f);
    Vec3f position(0.0f);
    int inJoints = 0, elsewhere = 0;
    for (const render::Ray& ray : rays) {
      if (!ray.hit()) continue;
      Place place;
      place.cutTriangle = ray.triangle, place.triangle = m_cut.triangle[ray.triangle];
      place.cutWeights = Vec3f(1.0f - ray.u - ray.v, ray.u, ray.v);
      place.weights = weightsBefore(m_surface, m_cut, place);
      ++(m_isJoint[place.triangle] ? inJoints : elsewhere);
      const texture::Vec3I& corner = m_surface.triangles[place.triangle];
      for (int k = 0; k < 3; ++k) position += m_surface.positions[corner[k]] * place.weights[k];
      for (std::size_t way = 0; way < m_ways.size(); ++way) {
        const Vec4f color = m_ways[way].color(place);
        luminance[way] += texture::luminance(color.asPointer()) * color[3];
      }
    }
    const std::size_t pixel = std::size_t(y) * std::size_t(seen.width) + std::size_t(x);
    const int hits = inJoints + elsewhere;
    seen.kind[pixel] = hits == 0              ? Kind::nothing
                       : inJoints == kPoints  ? Kind::joint
                       : elsewhere == kPoints ? Kind::elsewhere
                                              : Kind::mixed;
    if (hits == 0) return;
    seen.position[pixel] = position / float(hits);
    for (std::size_t way = 0; way < m_ways.size(); ++way)
      seen.lightness[way][pixel] = texture::encodeSrgb(luminance[way] / float(hits));
  }

 private:
  const texture::TexturedSurface& m_surface;
  const texture::CutSurface& m_cut;
  const std::vector<Way>& m_ways;
  const render::CameraRays& m_camera;
  std::vector<std::uint8_t> m_isJoint;  // of each triangle
  render::EmbreeScene m_scene;
};

}  // namespace

bool isOfSeveralPieces(const texture::Joint& joint, const texture::Torus& torus) {
  constexpr float kRounding = 0.01f;  // texels
  const auto differ = [&](const texture::CornerPlaces& places) {
    for (std::size_t label = 1; label < 3; ++label)
      for (std::size_t c = 0; c < 3; ++c)
        if ((torus.unwrapped(places[label][c], places[0][c]) - places[0][c]).length() > kRounding)
          return true;
    return false;
  };
  return differ(joint.shown) || differ(joint.former);
}

Seen look(const texture::TexturedSurface& surface, const texture::Joints& joints,
          const texture::CutSurface& cut, bool toroidal, const std::vector<Way>& ways,
          const render::CameraRays& camera, const PictureSize& size) {
  const auto [width, height] = size;
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  Seen seen{width, height, std::vector<Kind>(pixels), std::vector<Vec3f>(pixels, Vec3f(0.0f)),
            std::vector<std::vector<float>>(ways.size(), std::vector<float>(pixels, 0.0f))};
  const Looker looker(surface, joints, cut, toroidal, ways, camera);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < seen.width; ++x) looker.lookAt(x, y, seen);
  });
  return seen;
}

}  // namespace fluidtex::joints
