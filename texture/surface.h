// Plain structs that describe a surface at the stages of one frame: mesh, transported texture, textured
// surface.
// Arrays have one entry per vertex of level 0 (#V) unless said otherwise. Positions are in metres.
#pragma once

#include <openvdb/Types.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace fluidtex::texture {

using openvdb::Vec2f;
using openvdb::Vec3f;
using openvdb::Vec3I;
using openvdb::Vec4f;

// No vertex, triangle or other index.
inline constexpr std::uint32_t kNone = ~std::uint32_t(0);

// Gradient of the exemplar coordinate in world space, texels per metre. s: of the column,
// rightwards; t: of the row, downwards. Both are tangent to the surface. World space, so that the value
// does not depend on the axes that a vertex chooses.
struct TexelGradient {
  Vec3f s{0.0f}, t{0.0f};
};

// One level of detail: a closed, oriented, manifold mesh with evenly spaced vertices.
struct SurfaceMesh {
  double spacing = 0.0;  // sigma, metres: side of the square that one vertex stands for, one exemplar pixel
  std::vector<Vec3f> positions;    // #V
  std::vector<Vec3f> normals;      // #V, unit, outward: grad(phi), or the mesh normal on rims
  std::vector<Vec3I> triangles;    // #T, counter-clockwise seen from outside
  std::vector<Vec3f> orientation;  // #V, unit, tangent; empty before orient()
  std::vector<float> scale;        // #V: factor on the spacing, side of an exemplar pixel / spacing; empty: 1
  std::vector<float> guidance{};   // #V, 0..1: level of the guidance map that is wanted; empty: unguided
  std::vector<float> foam{};       // #V, 0..1: foam, where guidance follows it; else empty
  double spacingAt(std::uint32_t v) const { return scale.empty() ? spacing : spacing * double(scale[v]); }
};

// A vertex's local axes, seen from outside: d = orientation points along the exemplar's rows, rightwards, and
// b = d x n along its columns, downwards. ([Kwatra07] uses t = n x d = -b with the image upside down.) Local
// coordinates of a point x are l = ((x - p) . d, (x - p) . b) / spacingAt, in exemplar pixels.
inline Vec3f rowAxis(const Vec3f& d, const Vec3f& n) {
  return d.cross(n);
}

// Result of prepareSurface(). levels[0] is the finest; level L has 2^L times its spacing. Later frames have
// one level, until addCoarserLevels() adds more. No levels: there is no surface.
struct Surface {
  std::vector<SurfaceMesh> levels;
  bool empty() const { return levels.empty() || levels[0].positions.empty(); }
};

// Cross-fade at renewed vertices: the colour is mixed from the former exemplar coordinate and the new one
// until the weight of the former is 0.
struct Fading {
  std::vector<Vec2f> coordinate;  // former exemplar coordinate, texels
  std::vector<TexelGradient> gradient;
  std::vector<float> weight;  // 1 to 0, of the former colour; at 0 its coordinate means nothing
  std::vector<float> speed;   // 1/s, decrease of the weight
};

// No cross-fade, at `count` vertices.
inline Fading noFading(std::size_t count) {
  return {std::vector<Vec2f>(count, Vec2f(0.0f)), std::vector<TexelGradient>(count),
          std::vector<float>(count, 0.0f), std::vector<float>(count, 0.0f)};
}

// Texture at the vertices.
struct VertexTexture {
  std::vector<Vec4f> color;  // #V: linear RGBA, straight alpha
  std::vector<Vec2f>
      coordinate;  // #V: exemplar coordinate, texels; texel centres at integers, origin top left
  std::vector<TexelGradient> gradient;  // #V
  Fading fading;
  std::vector<float> age;               // #V, s since the texture was last renewed
  std::vector<float> trust;             // #V, 0..1: confidence in the transported values
  std::vector<Vec3f> previousPosition;  // #V: position one frame ago, on the old surface
  // #V, 1 where the texture is still that of the mesh which the liquid began with; empty: it began with none.
  std::vector<std::uint8_t> original{};
  // #V, metres: where the surface was when it came to light or was last reset (LaterFrames); else empty.
  std::vector<Vec3f> rest{}, secondRest{};
};

// The previous frame's texture, transported onto a new surface. Colours are barycentric means (used by method
// kwatra07). Gradients are deformed by the flow. Every array has one entry per vertex of levels[0]; on the
// first frame all are empty.
struct Carried : VertexTexture {
  std::vector<Vec3f> orientation;  // #V, unit, tangent, turned by the flow
  std::vector<float> foam;         // #V, 0..1, barycentric; empty where the old surface had none
  // #V, 1 where the flow goes through a surface that stays, and with it its texture: what rides with the flow
  // slides past it. May be empty: nowhere.
  std::vector<std::uint8_t> stays;
  // #V, factor on the wear of transported texture: 0 never renewed, above 1 renewed sooner. May be empty: 1.
  std::vector<float> renewal;
  float renewalAt(std::uint32_t v) const { return renewal.empty() ? 1.0f : renewal[v]; }
  bool empty() const { return previousPosition.empty(); }
};

// Report of synthesize().
struct SynthesisStats {
  double energyStart = 0.0, energyEnd = 0.0;  // energy E of the last pass: at its start, at its end
  int iterations = 0;                         // total over all levels and windows
  double renewed = 1.0;  // share of vertices whose exemplar coordinate is not the transported one
};

// The result of a frame: rendered, written, measured, and transported to the next frame. Its arrays are
// listed in texture/vertex_arrays.h.
struct TexturedSurface : SurfaceMesh, VertexTexture {
  std::vector<Vec3f> velocity;                        // #V, m/s
  std::vector<std::uint8_t> contact;                  // #V: 1 where the vertex touches a solid
  std::map<std::string, std::vector<float>> maps;     // #V each: further scalar maps of the exemplar, by name
  std::map<std::string, std::vector<Vec3f>> vectors;  // #V each: vector maps; world space, unit or zero
  int exemplarWidth = 0, exemplarHeight = 0;          // texels
  bool empty() const { return positions.empty(); }
};

// Gives the surface's vertices no texture: mid grey, coordinates 0, nothing that fades, age and trust 0, at
// rest where they are.
inline void clearTexture(TexturedSurface& surface) {
  const std::size_t count = surface.positions.size();
  static_cast<VertexTexture&>(surface) = {.color = std::vector<Vec4f>(count, Vec4f(0.5f, 0.5f, 0.5f, 1.0f)),
                                          .coordinate = std::vector<Vec2f>(count, Vec2f(0.0f)),
                                          .gradient = std::vector<TexelGradient>(count),
                                          .fading = noFading(count),
                                          .age = std::vector<float>(count, 0.0f),
                                          .trust = std::vector<float>(count, 0.0f),
                                          .previousPosition = surface.positions};
  surface.velocity.assign(count, Vec3f(0.0f));
  surface.contact.assign(count, 0);
}

}  // namespace fluidtex::texture
