#include "texture/measure/repeats.h"

#include "texture/exemplar/srgb.h"
#include "texture/measure/patches.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr int kWidth = 9, kHalf = kWidth / 2;
constexpr float kFar = 2.0f * kWidth;  // texels: closer windows are no repetition
constexpr float kBlur = 0.45f;         // texels, of the kernel that windows are read with
constexpr float kSupport = 1.3f;
constexpr float kLeastWeight = 1e-2f;  // of a texel that vertices are near to
constexpr std::size_t kMost = 40000;   // windows
constexpr int kAsked = 1000;

// The first `most` vertices in breadth-first order: a connected region.
std::vector<std::uint32_t> patchOf(const VertexGraph& graph, std::size_t most) {
  const std::size_t count = graph.first.size() - 1;
  std::vector<std::uint32_t> list;
  std::vector<char> seen(count, 0);
  for (std::uint32_t start = 0; start < count && list.size() < most; ++start) {
    if (seen[start]) continue;
    std::size_t next = list.size();
    list.push_back(start);
    seen[start] = 1;
    for (; next < list.size() && list.size() < most; ++next)
      for (const std::uint32_t u : graph.around(list[next]))
        if (!seen[u]) {
          seen[u] = 1;
          list.push_back(u);
        }
  }
  list.resize(std::min(list.size(), most));
  return list;
}

// Vertices around one, flattened in its axes.
class Neighbors {
 public:
  explicit Neighbors(const TileGround& ground)
      : m_ground(ground), m_seen(ground.surface.positions.size(), 0) {}

  const std::vector<std::pair<std::uint32_t, Vec2f>>& of(std::uint32_t v) {
    const TexturedSurface& surface = m_ground.surface;
    const Vec3f &n = surface.normals[v], &d = surface.orientation[v], b = rowAxis(d, n);
    ++m_turn;
    m_list.assign(1, {v, Vec2f(0.0f)});
    m_seen[v] = m_turn;
    for (std::size_t next = 0; next < m_list.size(); ++next)
      for (const std::uint32_t u : m_ground.graph.around(m_list[next].first)) {
        if (m_seen[u] == m_turn) continue;
        m_seen[u] = m_turn;
        const Vec3f from = (surface.positions[u] - surface.positions[v]) / float(surface.spacing);
        const Vec2f flat(from.dot(d), from.dot(b));
        const float reach = float(kHalf) + kSupport;
        if (std::abs(flat[0]) < reach && std::abs(flat[1]) < reach && surface.normals[u].dot(n) > 0.2f)
          m_list.emplace_back(u, flat);
      }
    return m_list;
  }

 private:
  const TileGround& m_ground;
  std::vector<std::uint32_t> m_seen;
  std::uint32_t m_turn = 0;
  std::vector<std::pair<std::uint32_t, Vec2f>> m_list;
};

// A window from scattered values around it. False if a texel has none near.
class Window {
 public:
  explicit Window(int channels) : m_channels(channels), m_values(std::size_t(kWidth * kWidth * channels)) {}

  void clear() {
    m_weights.fill(0.0f);
    std::fill(m_values.begin(), m_values.end(), 0.0f);
  }
  void add(const Vec2f& flat, const float* color) {
    const int x0 = std::max(int(std::ceil(flat[0] - kSupport)), -kHalf);
    const int x1 = std::min(int(std::floor(flat[0] + kSupport)), kHalf);
    const int y0 = std::max(int(std::ceil(flat[1] - kSupport)), -kHalf);
    const int y1 = std::min(int(std::floor(flat[1] + kSupport)), kHalf);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const float dx = float(x) - flat[0], dy = float(y) - flat[1];
        const float weight = std::exp(-0.5f * (dx * dx + dy * dy) / (kBlur * kBlur));
        const std::size_t at = std::size_t((y + kHalf) * kWidth + x + kHalf);
        m_weights[at] += weight;
        for (int c = 0; c < m_channels; ++c)
          m_values[at * std::size_t(m_channels) + std::size_t(c)] += weight * color[c];
      }
  }
  // Appends the window in CIELAB.
  bool finish(std::vector<float>& windows) {
    for (std::size_t at = 0; at < m_weights.size(); ++at) {
      if (m_weights[at] < kLeastWeight) return false;
      float* value = m_values.data() + at * std::size_t(m_channels);
      for (int c = 0; c < m_channels; ++c) value[c] /= m_weights[at];
      toPerceptual(value, m_channels);
    }
    windows.insert(windows.end(), m_values.begin(), m_values.end());
    return true;
  }

 private:
  int m_channels;
  std::array<float, kWidth * kWidth> m_weights{};
  std::vector<float> m_values;
};

}  // namespace

double repeatsOf(const TileGround& ground, const Image& picture, Dice& dice) {
  const TexturedSurface& surface = ground.surface;
  const int channels = picture.channels;
  std::vector<Vec4f> color(surface.color.size());
  for (std::size_t v = 0; v < color.size(); ++v) {
    for (int c = 0; c < 3; ++c) color[v][c] = encodeSrgb(surface.color[v][c]);
    color[v][3] = surface.color[v][3];
  }
  Neighbors neighbors(ground);
  Window window(channels);
  std::vector<float> shown, own;
  std::vector<std::uint32_t> where;
  std::vector<Vec2f> place;
  float sample[4];
  constexpr double kRim = kHalf + kSupport;
  for (const std::uint32_t v : patchOf(ground.graph, kMost)) {
    const auto& around = neighbors.of(v);
    window.clear();
    for (const auto& [u, flat] : around) window.add(flat, color[u].asPointer());
    if (!window.finish(shown)) continue;
    where.push_back(v);
    const double x = kRim + dice.unit() * std::max(picture.width - 1.0 - 2.0 * kRim, 0.0);
    const double y = kRim + dice.unit() * std::max(picture.height - 1.0 - 2.0 * kRim, 0.0);
    window.clear();
    for (const auto& [u, flat] : around) {
      sampleMirrored(picture, x + flat[0], y + flat[1], sample);
      window.add(flat, sample);
    }
    window.finish(own);
    place.emplace_back(float(x), float(y));
  }
  if (where.empty()) return 0.0;
  const float apart = kFar * float(surface.spacing);
  const auto farOnSurface = [&](std::size_t i, std::size_t j) {
    return (surface.positions[where[i]] - surface.positions[where[j]]).lengthSqr() > apart * apart;
  };
  const auto farInExemplar = [&](std::size_t i, std::size_t j) {
    return std::max(std::abs(place[i][0] - place[j][0]), std::abs(place[i][1] - place[j][1])) > kFar;
  };
  const int dimension = kWidth * kWidth * channels;
  return shareWithTwin(reducedWindows(shown, dimension), kAsked, farOnSurface) -
         shareWithTwin(reducedWindows(own, dimension), kAsked, farInExemplar);
}

}  // namespace fluidtex::texture
