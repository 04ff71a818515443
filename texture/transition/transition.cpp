// Based on: Kwatra, Schoedl, Essa, Turk and Bobick, "Graphcut textures", 2003: seam cost over the gradients
// (4.2); Boykov, Veksler and Zabih, "Fast approximate energy minimization via graph cuts", 2001: expansion.
#include "texture/transition/transition.h"

#include "numerics/random.h"
#include "texture/exemplar/srgb.h"
#include "texture/labels/min_cut.h"
#include "texture/transition/smooth_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

constexpr float kTolerance = 0.05f;   // deviation from the wanted share that costs nothing
constexpr float kAdherence = 100.0f;  // cost of a wrong piece of one feature, in lengths of seam around it
constexpr float kEdge = 6.0f;         // how much cheaper a seam is along a strong edge
constexpr int kProposals = 6;         // expansions for each feature's square
constexpr int kOffsets = 32;          // offsets tried for each
constexpr double kDiscRadius = 1.25;  // of an expansion, features
constexpr int kSteps[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

// A piece of a picture laid over the transition, moved by an offset.
struct Label {
  std::int32_t picture = 0, x = 0, y = 0;
  bool operator==(const Label&) const = default;
};

// A picture's pixels as they are compared: encoded premultiplied colour and alpha, and its gradient's length.
struct Compared {
  int width = 0, height = 0;
  std::vector<Vec4f> value;
  std::vector<float> gradient;
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(width) + std::size_t(x); }
};

Compared compared(const Image& image) {
  Compared result{image.width, image.height, {}, {}};
  const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
  result.value.resize(count);
  result.gradient.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float* pixel = image.data.data() + 4 * i;
    for (int c = 0; c < 3; ++c) result.value[i][c] = encodeSrgb(pixel[c]) * pixel[3];
    result.value[i][3] = pixel[3];
  }
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto value = [&](int i, int j) {
        return result.value[result.at(std::clamp(i, 0, image.width - 1), std::clamp(j, 0, image.height - 1))];
      };
      const Vec4f across = value(x + 1, y) - value(x - 1, y), down = value(x, y + 1) - value(x, y - 1);
      result.gradient[result.at(x, y)] = 0.5f * std::sqrt(across.dot(across) + down.dot(down));
    }
  return result;
}

class Strip {
 public:
  Strip(const Image& left, const Image& right, const TransitionOptions& options)
      : m_width(options.width),
        m_height(left.height),
        m_feature(options.feature),
        m_seed(options.seed),
        m_pictures{compared(left), compared(right)},
        m_first{left.width - options.width, 0},
        m_threshold(smoothNoise(m_width, m_height, 0.5 * options.feature, options.seed)) {
    // Units of difference and of gradient, so that contrast does not matter.
    double difference = 0.0;
    std::vector<float> gradients;
    for (std::uint64_t i = 0; i < 4096; ++i) {
      std::array<Vec4f, 2> values;
      for (std::size_t k = 0; k < 2; ++k) {
        const std::size_t at = randomBelow(m_seed + 1, 2 * i + k, m_pictures[k].value.size());
        values[k] = m_pictures[k].value[at];
        gradients.push_back(m_pictures[k].gradient[at]);
      }
      difference += (values[0] - values[1]).length() / 4096.0;
    }
    std::nth_element(gradients.begin(), gradients.begin() + std::ptrdiff_t(gradients.size() * 9 / 10),
                     gradients.end());
    m_difference = std::max(float(difference), 1e-4f);
    m_gradient = std::max(gradients[gradients.size() * 9 / 10], 1e-4f);
    m_labels.resize(std::size_t(m_width) * std::size_t(m_height));
    for (std::size_t p = 0; p < m_labels.size(); ++p)
      m_labels[p].picture = wanted(int(p) % m_width, p) ? 1 : 0;
    for (int y = 0; y < m_height; ++y) {
      m_labels[index(0, y)] = {0, 0, 0};
      m_labels[index(m_width - 1, y)] = {1, 0, 0};
    }
  }

  // The least visible outlines of pieces that lie where their pictures have them, then of pieces moved.
  void improve() {
    const int whole = std::max(m_width, m_height);
    for (int picture = 0; picture < 2; ++picture) expand(m_width / 2, m_height / 2, whole, {picture, 0, 0});
    const std::uint64_t count =
        std::uint64_t(kProposals) * m_labels.size() / std::uint64_t(m_feature * m_feature);
    const int radius = std::max(2, int(std::lround(kDiscRadius * m_feature)));
    for (std::uint64_t n = 0; n < count; ++n) {
      const int x = int(randomBelow(m_seed + 2, 3 * n, std::uint64_t(m_width)));
      const int y = int(randomBelow(m_seed + 2, 3 * n + 1, std::uint64_t(m_height)));
      const int picture = int(randomBelow(m_seed + 2, 3 * n + 2, 2));
      if (hasSeam(x, y, radius)) expand(x, y, radius, bestLabel(x, y, radius, picture, n));
    }
  }

  std::vector<PixelOrigin> sources() const {
    std::vector<PixelOrigin> result(m_labels.size());
    for (int y = 0; y < m_height; ++y)
      for (int x = 0; x < m_width; ++x) {
        const Label& label = m_labels[index(x, y)];
        result[index(x, y)] = {label.picture, x + m_first[std::size_t(label.picture)] + label.x, y + label.y};
      }
    return result;
  }

 private:
  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(m_width) + std::size_t(x); }
  float share(int x) const { return (float(x) + 0.5f) / float(m_width); }
  bool wanted(int x, std::size_t p) const { return share(x) > m_threshold[p]; }

  bool covers(const Label& label, int x, int y) const {
    const Compared& picture = m_pictures[std::size_t(label.picture)];
    const int i = x + m_first[std::size_t(label.picture)] + label.x, j = y + label.y;
    return i >= 0 && j >= 0 && i < picture.width && j < picture.height;
  }
  std::size_t place(const Label& label, int x, int y) const {
    return m_pictures[std::size_t(label.picture)].at(x + m_first[std::size_t(label.picture)] + label.x,
                                                     y + label.y);
  }
  const Vec4f& value(const Label& label, int x, int y) const {
    return m_pictures[std::size_t(label.picture)].value[place(label, x, y)];
  }
  float gradient(const Label& label, int x, int y) const {
    return m_pictures[std::size_t(label.picture)].gradient[place(label, x, y)];
  }

  // Of a pixel that shows the picture, by how much the other is wanted there.
  float ownCost(const Label& label, int x, int y) const {
    const float over = share(x) - m_threshold[index(x, y)];
    return kAdherence / float(m_feature) * std::max(0.0f, (label.picture == 0 ? over : -over) - kTolerance);
  }

  // Of the seam between two neighbours, [Kwatra03 (2)].
  float seamCost(const Label& a, const Label& b, int x, int y, int i, int j) const {
    if (a == b || !covers(a, i, j) || !covers(b, x, y)) return a == b ? 0.0f : 1.0f;
    const float difference =
        (value(a, x, y) - value(b, x, y)).length() + (value(a, i, j) - value(b, i, j)).length();
    const float edge = gradient(a, x, y) + gradient(a, i, j) + gradient(b, x, y) + gradient(b, i, j);
    const float diagonal = x != i && y != j ? 0.70710678f : 1.0f;
    return diagonal * difference / m_difference / (1.0f + kEdge * edge / (4.0f * m_gradient));
  }

  bool hasSeam(int x, int y, int radius) const {
    const Label& here = m_labels[index(x, y)];
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.25 * 3.14159265358979 * k;
      const int i = x + int(std::lround(0.7 * radius * std::cos(angle)));
      const int j = y + int(std::lround(0.7 * radius * std::sin(angle)));
      if (i >= 0 && j >= 0 && i < m_width && j < m_height && !(m_labels[index(i, j)] == here)) return true;
    }
    return false;
  }

  // The offset, of some at random and none, with which a picture looks most like what lies around a disc.
  Label bestLabel(int x, int y, int radius, int picture, std::uint64_t n) const {
    Label best{picture, 0, 0};
    float least = mismatch(x, y, radius, best);
    const Compared& there = m_pictures[std::size_t(picture)];
    const int reach = 2 * radius + 1;
    for (std::uint64_t k = 0; k < kOffsets && there.width > reach && there.height > reach; ++k) {
      const std::uint64_t draw = 2 * (n * kOffsets + k);
      const int i = radius + int(randomBelow(m_seed + 3, draw, std::uint64_t(there.width - reach)));
      const int j = radius + int(randomBelow(m_seed + 3, draw + 1, std::uint64_t(there.height - reach)));
      const Label label{picture, i - x - m_first[std::size_t(picture)], j - y};
      const float now = mismatch(x, y, radius, label);
      if (now < least) {
        least = now;
        best = label;
      }
    }
    return best;
  }

  // Mean difference in the outer half of a disc.
  float mismatch(int x, int y, int radius, const Label& label) const {
    float sum = 0.0f;
    int count = 0;
    for (int j = -radius; j <= radius; j += 2)
      for (int i = -radius; i <= radius; i += 2) {
        const int square = i * i + j * j;
        if (square > radius * radius || 2 * square < radius * radius) continue;
        const int s = x + i, t = y + j;
        if (s < 0 || t < 0 || s >= m_width || t >= m_height) continue;
        if (!covers(label, s, t)) return std::numeric_limits<float>::max();
        sum += (value(label, s, t) - value(m_labels[index(s, t)], s, t)).length();
        ++count;
      }
    return count > 0 ? sum / float(count) : std::numeric_limits<float>::max();
  }

  // Offers a label to the pixels of a disc, and gives it to those where that lowers the whole's cost the
  // most.
  void expand(int x, int y, int radius, const Label& label) {
    m_nodes.clear();
    m_number.assign(m_labels.size(), kNone);
    const bool everywhere = radius >= std::max(m_width, m_height);
    for (int j = std::max(0, y - radius); j <= std::min(m_height - 1, y + radius); ++j)
      for (int i = std::max(1, x - radius); i <= std::min(m_width - 2, x + radius); ++i) {
        if (!everywhere && (i - x) * (i - x) + (j - y) * (j - y) > radius * radius) continue;
        if (!covers(label, i, j) || m_labels[index(i, j)] == label) continue;
        m_number[index(i, j)] = std::uint32_t(m_nodes.size());
        m_nodes.push_back({i, j});
      }
    if (m_nodes.empty()) return;
    m_cut.reset(m_nodes.size());
    for (std::uint32_t n = 0; n < m_nodes.size(); ++n) {
      const auto [i, j] = m_nodes[n];
      const Label& old = m_labels[index(i, j)];
      m_cut.addOwn(n, ownCost(old, i, j), ownCost(label, i, j));
      for (const auto& step : kSteps)
        for (const int sign : {1, -1}) {
          const int s = i + sign * step[0], t = j + sign * step[1];
          if (s < 0 || t < 0 || s >= m_width || t >= m_height) continue;
          const Label& beside = m_labels[index(s, t)];
          const std::uint32_t other = m_number[index(s, t)];
          const float keep = seamCost(old, beside, i, j, s, t), take = seamCost(label, beside, i, j, s, t);
          if (other == kNone) {
            m_cut.addOwn(n, keep, take);
          } else if (sign > 0) {
            // keep + (take - keep) x - take y + (change + take - keep) (1 - x) y, x and y 1 where taken.
            const float change = seamCost(old, label, i, j, s, t);
            m_cut.addOwn(n, std::max(0.0f, keep - take), std::max(0.0f, take - keep));
            m_cut.addOwn(other, take, 0.0f);
            m_cut.addPair(n, other, std::max(0.0f, change + take - keep), 0.0f);
          }
        }
    }
    m_cut.solve();
    std::vector<Label> before;
    const double cost = costAround();
    before.reserve(m_nodes.size());
    for (std::uint32_t n = 0; n < m_nodes.size(); ++n) {
      Label& here = m_labels[index(m_nodes[n][0], m_nodes[n][1])];
      before.push_back(here);
      if (m_cut.takes(n)) here = label;
    }
    if (costAround() < cost) return;
    for (std::uint32_t n = 0; n < m_nodes.size(); ++n)
      m_labels[index(m_nodes[n][0], m_nodes[n][1])] = before[n];
  }

  // Cost of the nodes and of their seams.
  double costAround() const {
    double cost = 0.0;
    for (const auto& [i, j] : m_nodes) {
      const Label& here = m_labels[index(i, j)];
      cost += ownCost(here, i, j);
      for (const auto& step : kSteps)
        for (const int sign : {1, -1}) {
          const int s = i + sign * step[0], t = j + sign * step[1];
          if (s < 0 || t < 0 || s >= m_width || t >= m_height) continue;
          if (sign < 0 && m_number[index(s, t)] != kNone) continue;
          cost += seamCost(here, m_labels[index(s, t)], i, j, s, t);
        }
    }
    return cost;
  }

  int m_width, m_height, m_feature;
  std::uint64_t m_seed;
  std::array<Compared, 2> m_pictures;
  std::array<int, 2> m_first;      // column of each picture under the transition's first
  std::vector<float> m_threshold;  // share from which the second picture is wanted
  float m_difference = 1.0f, m_gradient = 1.0f;
  std::vector<Label> m_labels;
  MinCut m_cut;
  std::vector<std::array<int, 2>> m_nodes;
  std::vector<std::uint32_t> m_number;
};

}  // namespace

std::vector<PixelOrigin> transition(const Image& left, const Image& right, const TransitionOptions& options) {
  if (left.channels != 4 || right.channels != 4 || left.height != right.height || left.height < 1)
    throw std::invalid_argument("transition: the pictures must be RGBA, of one height");
  if (options.width < 8 || options.width > std::min(left.width, right.width))
    throw std::invalid_argument("transition: its width must be 8 or more, and at most that of each picture");
  if (options.feature < 2) throw std::invalid_argument("transition: a feature must have 2 pixels or more");
  Strip strip(left, right, options);
  strip.improve();
  return strip.sources();
}

}  // namespace fluidtex::texture
