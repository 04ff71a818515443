// Square pieces of a surface laid flat, and pictures read from them: what likeness is judged by.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/orientation/tangent.h"
#include "texture/surface.h"

#include <array>
#include <vector>

namespace fluidtex::texture {

// Random numbers one after the other.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : m_seed(seed) {}
  double unit();                             // in [0, 1)
  std::uint64_t below(std::uint64_t count);  // in 0 .. count - 1
  double normal();                           // of variance 1

 private:
  std::uint64_t m_seed, m_counter = 0;
};

// Pictures of one size: count x height x width x channels.
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

// A texel of a tile is read from six vertices.
inline constexpr int kReadFrom = 6;

struct Tile {
  std::vector<std::uint32_t> vertex;  // all that it is read from
  std::vector<Vec2f> flat;            // where they lie on the tile, texels from its middle
  struct Reading {
    std::array<std::uint32_t, kReadFrom> index;  // into `vertex`
    std::array<float, kReadFrom> weight;         // sum 1
  };
  std::vector<Reading> texels;  // size x size
};

// A mesh with what tiles are laid out by. Refers to the surface.
struct TileGround {
  explicit TileGround(const TexturedSurface& surface);
  const TexturedSurface& surface;
  VertexGraph graph;
  VertexGraph around;    // each vertex's neighbours and theirs, itself first
  double spacing = 0.0;  // m, median over the vertices of the mean of their four shortest edges
};

// Vertices near a place, nearest first, and smooth weights of sum 1.
using SmoothReading = std::array<std::pair<float, std::uint32_t>, kReadFrom>;

// Of x, whose nearest vertex is `at`, which may be left out. Returns the distance of the nearest in metres.
double readAt(const TileGround& ground, const Vec3f& x, std::uint32_t at, bool withoutIt,
              SmoothReading& found);

// `count` tiles of size x size texels of surface.spacing about random vertices, at random angles; fewer where
// 12 times as many vertices do not give them: a tile bends by at most 40 degrees in the mean.
std::vector<Tile> flatTiles(const TileGround& ground, int size, int count, Dice& dice);

// sRGB-encoded picture of the exemplar: 3 channels, or 4 where alpha varies.
Image encodedPicture(const Image& color);

// Linear RGBA as it is seen before mid grey, sRGB-encoded.
Vec3f seenColor(const Vec4f& color);

// All of a surface's, or of an image's, which has three channels then.
std::vector<Vec3f> seenColors(const TexturedSurface& surface);
Image seenPicture(const Image& color);
// Its luminance: one channel.
Image seenLuminance(const Image& color);

// The value that a share of them is at most, 0 of none.
double percentile(std::vector<float> values, double share);

// The surface's colours on the tiles, as encodedPicture() has them, and the exemplar laid on the same
// vertices at random places and angles; both in CIELAB / 100 over mid grey (and alpha). Tiles are gone
// through more than once where there are fewer than `count`.
Stack colorTiles(const TexturedSurface& surface, const std::vector<Tile>& tiles, int size, int channels);
Stack exemplarTiles(const Image& picture, const std::vector<Tile>& tiles, int size, int count, Dice& dice);

// CIELAB / 100 of sRGB in place; with a fourth value, alpha, over mid grey.
void toPerceptual(float* color, int channels);

// Bilinear, mirrored at the middles of the outermost texels.
void sampleMirrored(const Image& image, double x, double y, float* out);

}  // namespace fluidtex::texture
