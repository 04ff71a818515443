#include "texture/measure/tiles.h"

#include "numerics/random.h"
#include "texture/exemplar/srgb.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace fluidtex::texture {
namespace {

using std::numbers::pi;

constexpr float kMidGrey = 0.5f;  // sRGB-encoded, behind what is see-through
constexpr int kSlides = 3;        // projections onto the surface along the tile's normal
constexpr double kBend = 40.0;    // degrees a tile may bend
constexpr double kReach = 1.6;    // spacings: farther from all vertices a texel is off the surface
constexpr double kOff = 0.02;     // share of a tile's texels that may be off or face the other way

float distance2(const Vec3f& a, const Vec3f& b) {
  return (a - b).lengthSqr();
}

// Vertex nearest to x, by descent from neighbour to neighbour.
std::uint32_t nearest(const TileGround& ground, const Vec3f& x, std::uint32_t from) {
  const std::vector<Vec3f>& positions = ground.surface.positions;
  float best = distance2(positions[from], x);
  for (bool moved = true; moved;) {
    moved = false;
    for (const std::uint32_t u : ground.graph.around(from)) {
      const float d = distance2(positions[u], x);
      if (d >= best) continue;
      best = d;
      from = u;
      moved = true;
      break;
    }
  }
  return from;
}

class TileLayer {
 public:
  TileLayer(const TileGround& ground, int size)
      : m_ground(ground),
        m_size(size),
        m_slot(ground.surface.positions.size(), -1),
        m_place(std::size_t(size) * size),
        m_near(m_place.size()) {}

  std::optional<Tile> lay(std::uint32_t center, double angle) {
    const TexturedSurface& surface = m_ground.surface;
    const Vec3f n = surface.normals[center], middle = surface.positions[center];
    const Vec3f e = std::abs(n.x()) < 0.8f ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0);
    const Vec3f t0 = n.cross(e).unit(), b0 = n.cross(t0);
    const float c = float(std::cos(angle)), s = float(std::sin(angle));
    const Vec3f t = t0 * c + b0 * s, b = b0 * c - t0 * s;
    const float texel = float(surface.spacing), half = 0.5f * float(m_size - 1);
    for (int y = 0; y < m_size; ++y)
      for (int x = 0; x < m_size; ++x)
        m_place[at(y, x)] = middle + t * ((float(x) - half) * texel) + b * ((float(y) - half) * texel);
    for (int pass = 0; pass < kSlides; ++pass)
      if (!slide(n, pass == 0 ? std::optional(center) : std::nullopt)) return std::nullopt;
    return read(n, t, b, middle);
  }

 private:
  std::size_t at(int y, int x) const { return std::size_t(y) * m_size + x; }

  // From the middle outwards, so that the search starts near its result. False if too much faces away.
  bool slide(const Vec3f& n, std::optional<std::uint32_t> center) {
    const int mid = m_size / 2, limit = int(kOff * double(m_place.size()));
    const float most = 3.0f * float(m_size) * float(m_ground.surface.spacing);
    int away = 0;
    for (int row = 0; row < m_size; ++row) {
      const int y = row < m_size - mid ? mid + row : m_size - 1 - row;
      for (int column = 0; column < m_size; ++column) {
        const int x = column < m_size - mid ? mid + column : m_size - 1 - column;
        const std::size_t k = at(y, x);
        std::uint32_t from = m_near[k];
        if (center) {
          if (y == mid) {
            from = x == mid ? *center : m_near[at(y, x > mid ? x - 1 : x + 1)];
          } else {
            from = m_near[at(y > mid ? y - 1 : y + 1, x)];
          }
        }
        m_near[k] = nearest(m_ground, m_place[k], from);
        const Vec3f& normal = m_ground.surface.normals[m_near[k]];
        const float facing = normal.dot(n);
        if (facing < 0.0f && ++away > limit) return false;
        const float off = (m_ground.surface.positions[m_near[k]] - m_place[k]).dot(normal) /
                          (std::abs(facing) < 0.3f ? 0.3f : facing);
        m_place[k] += n * std::clamp(off, -most, most);
      }
    }
    return true;
  }

  std::optional<Tile> read(const Vec3f& n, const Vec3f& t, const Vec3f& b, const Vec3f& middle) {
    const double cosine = std::cos(kBend * pi / 180.0);
    const TexturedSurface& surface = m_ground.surface;
    Tile tile;
    tile.texels.resize(m_place.size());
    double facing = 0.0;
    std::size_t off = 0;
    bool good = true;
    SmoothReading found;
    for (std::size_t k = 0; good && k < m_place.size(); ++k) {
      const std::uint32_t v = nearest(m_ground, m_place[k], m_near[k]);
      off += readAt(m_ground, m_place[k], v, false, found) > kReach * m_ground.spacing;
      const double cos = surface.normals[found[0].second].dot(n);
      facing += cos;
      good = cos >= cosine - 0.25;
      for (int i = 0; i < kReadFrom; ++i) {
        std::int32_t& slot = m_slot[found[i].second];
        if (slot < 0) {
          slot = std::int32_t(tile.vertex.size());
          tile.vertex.push_back(found[i].second);
        }
        tile.texels[k].index[i] = std::uint32_t(slot);
        tile.texels[k].weight[i] = found[i].first;
      }
    }
    for (const std::uint32_t v : tile.vertex) {
      m_slot[v] = -1;
      const Vec3f from = (surface.positions[v] - middle) / float(surface.spacing);
      tile.flat.emplace_back(from.dot(t), from.dot(b));
    }
    const double count = double(m_place.size());
    if (!good || facing < cosine * count || double(off) > kOff * count) return std::nullopt;
    return tile;
  }

  const TileGround& m_ground;
  int m_size;
  std::vector<std::int32_t> m_slot;  // of each vertex in the tile, -1 where it is not in it
  std::vector<Vec3f> m_place;        // of each texel
  std::vector<std::uint32_t> m_near;
};

// Interpolates values at a tile's vertices to its texels.
void readTile(const Tile& tile, const std::vector<float>& values, int channels, float* out) {
  for (const Tile::Reading& texel : tile.texels) {
    std::fill_n(out, channels, 0.0f);
    for (int i = 0; i < kReadFrom; ++i)
      for (int c = 0; c < channels; ++c)
        out[c] += texel.weight[i] * values[std::size_t(texel.index[i]) * channels + c];
    toPerceptual(out, channels);
    out += channels;
  }
}

}  // namespace

double Dice::unit() {
  return randomUnit(m_seed, m_counter++);
}

std::uint64_t Dice::below(std::uint64_t count) {
  return randomBelow(m_seed, m_counter++, count);
}

// Box and Muller.
double Dice::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - unit()));
  return radius * std::cos(2.0 * pi * unit());
}

TileGround::TileGround(const TexturedSurface& textured)
    : surface(textured), graph(buildVertexGraph(textured)) {
  const std::size_t count = surface.positions.size();
  around.first.assign(1, 0);
  std::vector<std::uint32_t> list;
  std::vector<float> lengths, edges;
  for (std::uint32_t v = 0; v < count; ++v) {
    list.assign(1, v);
    edges.clear();
    for (const std::uint32_t u : graph.around(v)) {
      list.push_back(u);
      edges.push_back((surface.positions[u] - surface.positions[v]).length());
      for (const std::uint32_t w : graph.around(u)) list.push_back(w);
    }
    std::sort(list.begin() + 1, list.end());
    list.erase(std::unique(list.begin() + 1, list.end()), list.end());
    for (const std::uint32_t u : list)
      if (u != v || around.neighbor.size() == around.first.back()) around.neighbor.push_back(u);
    around.first.push_back(std::uint32_t(around.neighbor.size()));
    std::sort(edges.begin(), edges.end());
    const std::size_t most = std::min<std::size_t>(4, edges.size());
    float sum = 0.0f;
    for (std::size_t i = 0; i < most; ++i) sum += edges[i];
    lengths.push_back(most > 0 ? sum / float(most) : 0.0f);
  }
  std::nth_element(lengths.begin(), lengths.begin() + std::ptrdiff_t(count / 2), lengths.end());
  spacing = count > 0 ? lengths[count / 2] : 0.0;
}

double readAt(const TileGround& ground, const Vec3f& x, std::uint32_t at, bool withoutIt,
              SmoothReading& found) {
  found.fill({std::numeric_limits<float>::max(), at});
  for (const std::uint32_t u : ground.around.around(at)) {
    if (withoutIt && u == at) continue;
    std::pair<float, std::uint32_t> entry{distance2(ground.surface.positions[u], x), u};
    if (entry.first >= found.back().first) continue;
    for (auto& slot : found)
      if (entry < slot) std::swap(entry, slot);
  }
  const double first = std::sqrt(found[0].first);
  const double h = std::max(0.45 * ground.spacing, 0.6 * first);
  double sum = 0.0;
  for (auto& [d, u] : found) {
    d = float(std::exp(-0.5 * d / (h * h)));
    sum += d;
  }
  for (auto& entry : found) entry.first = float(entry.first / sum);
  return first;
}

std::vector<Tile> flatTiles(const TileGround& ground, int size, int count, Dice& dice) {
  std::vector<Tile> tiles;
  TileLayer layer(ground, size);
  for (int tried = 0; tried < 12 * count && int(tiles.size()) < count; ++tried) {
    const auto center = std::uint32_t(dice.below(ground.surface.positions.size()));
    if (auto tile = layer.lay(center, 2.0 * pi * dice.unit())) tiles.push_back(std::move(*tile));
  }
  return tiles;
}

Vec3f seenColor(const Vec4f& color) {
  Vec3f seen;
  for (int c = 0; c < 3; ++c) seen[c] = encodeSrgb(color[c]) * color[3] + kMidGrey * (1.0f - color[3]);
  return seen;
}

std::vector<Vec3f> seenColors(const TexturedSurface& surface) {
  std::vector<Vec3f> colors(surface.color.size());
  std::transform(surface.color.begin(), surface.color.end(), colors.begin(), seenColor);
  return colors;
}

Image seenPicture(const Image& color) {
  Image picture{color.width, color.height, 3, {}};
  for (std::size_t i = 0; i < color.data.size(); i += 4) {
    const Vec3f seen = seenColor(Vec4f(color.data.data() + i));
    picture.data.insert(picture.data.end(), seen.asPointer(), seen.asPointer() + 3);
  }
  return picture;
}

Image seenLuminance(const Image& color) {
  const Image picture = seenPicture(color);
  Image result{picture.width, picture.height, 1, {}};
  for (std::size_t i = 0; i < picture.data.size(); i += 3)
    result.data.push_back(luminance(picture.data.data() + i));
  return result;
}

double percentile(std::vector<float> values, double share) {
  if (values.empty()) return 0.0;
  const auto at =
      values.begin() + std::ptrdiff_t(std::min(double(values.size() - 1), share * double(values.size())));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Image encodedPicture(const Image& color) {
  bool opaque = true;
  for (std::size_t i = 3; i < color.data.size(); i += 4) opaque = opaque && color.data[i] > 0.999f;
  Image picture{color.width, color.height, opaque ? 3 : 4, {}};
  for (std::size_t i = 0; i < color.data.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) picture.data.push_back(encodeSrgb(color.data[i + c]));
    if (!opaque) picture.data.push_back(color.data[i + 3]);
  }
  return picture;
}

Stack colorTiles(const TexturedSurface& surface, const std::vector<Tile>& tiles, int size, int channels) {
  Stack stack(int(tiles.size()), size, size, channels);
  std::vector<float> values;
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    values.clear();
    for (const std::uint32_t v : tiles[k].vertex)
      for (int c = 0; c < channels; ++c)
        values.push_back(c < 3 ? encodeSrgb(surface.color[v][c]) : surface.color[v][c]);
    readTile(tiles[k], values, channels, stack.at(int(k), 0, 0));
  }
  return stack;
}

Stack exemplarTiles(const Image& picture, const std::vector<Tile>& tiles, int size, int count, Dice& dice) {
  constexpr int kTurns = 8;
  const int placements = std::max(count, int(tiles.size()));
  Stack stack(placements, size, size, picture.channels);
  std::vector<float> values;
  std::vector<Vec2f> turned;
  for (int k = 0; k < placements; ++k) {
    const Tile& tile = tiles[std::size_t(k) % tiles.size()];
    const double angle = 2.0 * pi * (k % kTurns + dice.unit() - 0.5) / kTurns;
    const float c = float(std::cos(angle)), s = float(std::sin(angle));
    Vec2f low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
    turned.clear();
    for (const Vec2f& p : tile.flat) {
      turned.emplace_back(c * p[0] - s * p[1], s * p[0] + c * p[1]);
      for (int a = 0; a < 2; ++a) {
        low[a] = std::min(low[a], turned.back()[a]);
        high[a] = std::max(high[a], turned.back()[a]);
      }
    }
    const double x0 = dice.unit() * std::max(picture.width - 1.0 - (high[0] - low[0]), 1e-3) - low[0];
    const double y0 = dice.unit() * std::max(picture.height - 1.0 - (high[1] - low[1]), 1e-3) - low[1];
    values.resize(turned.size() * std::size_t(picture.channels));
    for (std::size_t i = 0; i < turned.size(); ++i)
      sampleMirrored(picture, turned[i][0] + x0, turned[i][1] + y0,
                     values.data() + i * std::size_t(picture.channels));
    readTile(tile, values, picture.channels, stack.at(k, 0, 0));
  }
  return stack;
}

void toPerceptual(float* color, int channels) {
  float linear[3];
  for (int c = 0; c < 3; ++c) {
    const float over = channels == 4 ? color[c] * color[3] + kMidGrey * (1.0f - color[3]) : color[c];
    linear[c] = decodeSrgb(std::clamp(over, 0.0f, 1.0f));
  }
  const float xyz[3] = {
      (0.4124564f * linear[0] + 0.3575761f * linear[1] + 0.1804375f * linear[2]) / 0.95047f,
      0.2126729f * linear[0] + 0.7151522f * linear[1] + 0.0721750f * linear[2],
      (0.0193339f * linear[0] + 0.1191920f * linear[1] + 0.9503041f * linear[2]) / 1.08883f};
  float f[3];
  for (int c = 0; c < 3; ++c)
    f[c] = xyz[c] > 0.008856f ? std::cbrt(xyz[c]) : 7.787f * xyz[c] + 16.0f / 116.0f;
  color[0] = 1.16f * f[1] - 0.16f;
  color[1] = 5.0f * (f[0] - f[1]);
  color[2] = 2.0f * (f[1] - f[2]);
}

void sampleMirrored(const Image& image, double x, double y, float* out) {
  const auto mirrored = [](int i, int size) {
    if (size == 1) return 0;
    const int period = 2 * size - 2;
    i = ((i % period) + period) % period;
    return i < size ? i : period - i;
  };
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const float fx = float(x - i), fy = float(y - j);
  const int x0 = mirrored(i, image.width), x1 = mirrored(i + 1, image.width);
  const int y0 = mirrored(j, image.height), y1 = mirrored(j + 1, image.height);
  for (int c = 0; c < image.channels; ++c) {
    const float top = image.at(x0, y0)[c] * (1.0f - fx) + image.at(x1, y0)[c] * fx;
    const float bottom = image.at(x0, y1)[c] * (1.0f - fx) + image.at(x1, y1)[c] * fx;
    out[c] = top * (1.0f - fy) + bottom * fy;
  }
}

}  // namespace fluidtex::texture
