// Square pieces of a surface, flattened, and pictures read from them.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/mesh/vertex_graph.h"
#include "texture/surface.h"

#include <array>
#include <vector>

namespace fluidtex::texture {

// A sequence of random numbers.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : m_seed(seed) {}
  double unit();                             // in [0, 1)
  std::uint64_t below(std::uint64_t count);  // in 0 .. count - 1
  double normal();                           // of variance 1

 private:
  std::uint64_t m_seed, m_counter = 0;
};

// Pictures of equal size: count x height x width x channels.
struct Stack {
  int count = 0, height = 0, width = 0, channels = 0;
  std::vector<float> data;
  Stack(int pictures, int rows, int columns, int perTexel)
      : count(pictures),
        height(rows),
        width(columns),
        channels(perTexel),
        data(std::size_t(pictures) * rows * columns * perTexel) {}
  float* at(int picture, int y, int x) {
    return data.data() + ((std::size_t(picture) * height + y) * width + x) * channels;
  }
  const float* at(int picture, int y, int x) const {
    return data.data() + ((std::size_t(picture) * height + y) * width + x) * channels;
  }
};

// Vertices that a texel of a tile is interpolated from.
inline constexpr int kReadFrom = 6;

struct Tile {
  std::vector<std::uint32_t> vertex;  // all vertices it is read from
  std::vector<Vec2f> flat;            // their positions on the tile, texels from its centre
  struct Reading {
    std::array<std::uint32_t, kReadFrom> index;  // into `vertex`
    std::array<float, kReadFrom> weight;         // sum 1
  };
  std::vector<Reading> texels;  // size x size
};

// A mesh with the data for laying out tiles. Keeps a reference to the surface. Throws std::invalid_argument
// if the mesh is not closed and manifold, as all measures do that use it.
struct TileGround {
  explicit TileGround(const TexturedSurface& surface);
  const TexturedSurface& surface;
  VertexGraph graph;
  VertexGraph around;    // two-rings, each with its vertex first
  double spacing = 0.0;  // m, median over the vertices of the mean of their four shortest edges
};

// Vertices near a position, nearest first, with smooth weights of sum 1.
using SmoothReading = std::array<std::pair<float, std::uint32_t>, kReadFrom>;

// The reading at x, whose nearest vertex is `at`, without that vertex if `withoutIt`. Returns the distance of
// the nearest vertex used, metres.
double readAt(const TileGround& ground, const Vec3f& x, std::uint32_t at, bool withoutIt,
              SmoothReading& found);

// `count` tiles of size x size texels of surface.spacing, around random vertices at random angles; fewer if
// 12 count vertices do not give that many. A tile's normals deviate from that of its centre by at most 40
// degrees on average (mean cosine) and 59 degrees anywhere. At most 2% of its texels may lie off the surface.
std::vector<Tile> flatTiles(const TileGround& ground, int size, int count, Dice& dice);

// sRGB-encoded picture of the exemplar: 3 channels, or 4 where alpha varies.
Image encodedPicture(const Image& color);

// Linear RGBA composited over mid grey, sRGB-encoded.
Vec3f seenColor(const Vec4f& color);

// The same for a surface, or for an image, which then has three channels.
std::vector<Vec3f> seenColors(const TexturedSurface& surface);
Image seenPicture(const Image& color);
// Luminance of seenPicture(): one channel.
Image seenLuminance(const Image& color);

// The value that `share` of the values do not exceed; 0 if there are none.
double percentile(std::vector<float> values, double share);

// The surface's colours on the tiles, and those of `picture`, the exemplar as from encodedPicture(), on the
// same vertices at random positions and rotations. Interpolated as sRGB-encoded values, then converted to
// CIELAB / 100, transparent colours over mid grey; with 4 channels the last is alpha. exemplarTiles() uses
// tiles again until there are `count` pictures.
Stack colorTiles(const TexturedSurface& surface, const std::vector<Tile>& tiles, int size, int channels);
Stack exemplarTiles(const Image& picture, const std::vector<Tile>& tiles, int size, int count, Dice& dice);

// sRGB to CIELAB / 100, in place; with a fourth value, alpha, composited over mid grey.
void toPerceptual(float* color, int channels);

// Bilinear, mirrored at the centres of the outermost texels.
void sampleMirrored(const Image& image, double x, double y, float* out);

}  // namespace fluidtex::texture
