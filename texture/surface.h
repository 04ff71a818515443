// Plain values that stand for a surface at the various stages of one frame. Arrays are per vertex of level 0
// unless said otherwise, positions in metres.
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

// d(exemplar coordinate)/d(world position), texels per metre: row 0 for s (columns of the image, rightwards),
// row 1 for t (rows, downwards); both rows tangent to the surface. Carried in world space, so that it means
// the same whatever frame a vertex chooses.
struct TexelGradient {
  Vec3f s{0.0f}, t{0.0f};
};

// One level of detail: a closed, oriented, manifold mesh whose vertices are spread evenly over the surface.
struct SurfaceMesh {
  double spacing = 0.0;  // sigma: side of the square that one vertex stands for; one exemplar pixel, metres
  std::vector<Vec3f> positions;    // #V
  std::vector<Vec3f> normals;      // #V, unit, outward: grad(phi), or the mesh's own on rims
  std::vector<Vec3I> triangles;    // #T, counter-clockwise seen from outside
  std::vector<Vec3f> orientation;  // #V, unit, tangent; empty before orient()
  std::vector<float> scale;  // #V: an exemplar pixel's side is spacing * scale there; empty: 1 everywhere
  std::vector<float> guidance{};  // #V, 0..1: the level of the guidance map that is wanted there; empty: none
  std::vector<float> foam{};      // #V, 0..1, where guidance follows it; else empty
  double spacingAt(std::uint32_t v) const { return scale.empty() ? spacing : spacing * double(scale[v]); }
};

// A vertex's local axes: d = orientation runs along the exemplar's columns to the right, b = d x n along its
// rows downwards, seen from outside. ([Kwatra07] uses t = n x d = -b with the image upside down.) Local
// coordinates are l = ((x - p) . d, (x - p) . b) / spacingAt, in exemplar pixels.
inline Vec3f rowAxis(const Vec3f& d, const Vec3f& n) {
  return d.cross(n);
}

// What prepareSurface() makes: levels[0] is the finest; coarser ones have 2^L times its spacing. Level count
// is one where the texture is carried over from an earlier frame. Empty (no levels) when there is no surface.
struct Surface {
  std::vector<SurfaceMesh> levels;
  bool empty() const { return levels.empty() || levels[0].positions.empty(); }
};

// What renewed vertices showed before. Their colour is mixed from the old place and the new until the old one
// has faded.
struct Fading {
  std::vector<Vec2f> coordinate;  // exemplar coordinate, texels
  std::vector<TexelGradient> gradient;
  std::vector<float> weight;  // 1: all of the colour is the old place's, 0: none, and the place means nothing
  std::vector<float> speed;   // 1/s: by how much the weight falls
};

// Nothing that fades, at `count` vertices.
inline Fading noFading(std::size_t count) {
  return {std::vector<Vec2f>(count, Vec2f(0.0f)), std::vector<TexelGradient>(count),
          std::vector<float>(count, 0.0f), std::vector<float>(count, 0.0f)};
}

// What each vertex shows.
struct VertexTexture {
  std::vector<Vec4f> color;  // #V: linear RGBA, straight alpha
  std::vector<Vec2f>
      coordinate;  // #V: exemplar coordinate, texels; texel centres at integers, origin top left
  std::vector<TexelGradient> gradient;  // #V
  Fading fading;
  std::vector<float> age;               // #V: s since the texture here was last renewed
  std::vector<float> trust;             // #V, 0..1: how far what was carried here can be believed
  std::vector<Vec3f> previousPosition;  // #V: where the vertex was one frame ago, on the old surface
};

// The earlier frame's texture brought onto a new surface: colours are barycentric means (what method kwatra07
// carries), gradients those after the flow's deformation. Every array has one entry per vertex of levels[0],
// or none at all on the first frame.
struct Carried : VertexTexture {
  std::vector<Vec3f> orientation;  // unit, tangent, turned with the flow
  std::vector<float> foam;         // 0..1, barycentric; empty where the earlier surface had none
  bool empty() const { return previousPosition.empty(); }
};

// What synthesize() reports.
struct SynthesisStats {
  double energyStart = 0.0, energyEnd = 0.0;  // E of the last pass's window, before and after
  int iterations = 0;                         // all levels and windows
  double renewed = 1.0;  // share of vertices whose exemplar coordinate is not the carried one
};

// The end product of a frame: rendered, written, measured, and carried to the next. texture/vertex_arrays.h
// lists its arrays.
struct TexturedSurface : SurfaceMesh, VertexTexture {
  std::vector<Vec3f> velocity;                        // #V, m/s
  std::vector<std::uint8_t> contact;                  // #V: 1 where the vertex touches a solid
  std::map<std::string, std::vector<float>> maps;     // #V each: further maps of the exemplar by name
  std::map<std::string, std::vector<Vec3f>> vectors;  // #V each: unit or zero, in space: maps of vectors
  int exemplarWidth = 0, exemplarHeight = 0;          // texels
  bool empty() const { return positions.empty(); }
};

}  // namespace fluidtex::texture
