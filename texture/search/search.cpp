// k-coherence lists: X. Tong et al., "Synthesis of bidirectional texture functions on arbitrary surfaces",
// 2002.

#include "texture/search/search.h"
#include "numerics/random.h"

#include "numerics/lanes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace fluidtex::texture {
namespace {

constexpr int kLeaves = 256;
constexpr int kWindowsPerLeaf = 32;         // at least, so that small exemplars get fewer leaves
constexpr std::int64_t kCenters = 1 << 17;  // more centres are thinned by the stride
constexpr int kSimilarProbes = 2;

int wrapped(int i, int n) {
  i %= n;
  return i < 0 ? i + n : i;
}

// Floats in a row of a window, padded to whole registers.
std::size_t paddedRow(const SearchTable& table) {
  return (std::size_t(table.window * table.channels) + 7) / 8 * 8;
}

int centersAcross(int size, int window, bool toroidal, int stride) {
  return ((toroidal ? size : size - window + 1) + stride - 1) / stride;
}

Vec2i treeCenter(const SearchTable& table, std::uint32_t index) {
  const int columns = centersAcross(table.width, table.window, table.toroidal, table.stride);
  return table.minCenter() + Vec2i(int(index) % columns, int(index) / columns) * table.stride;
}

Image padded(const Image& match, int margin) {
  Image result{match.width + 2 * margin, match.height + 2 * margin, match.channels, {}};
  const std::size_t size =
      std::size_t(result.width) * std::size_t(result.height) * std::size_t(result.channels);
  // Rows of windows are read in whole registers, a few floats beyond the last pixel.
  result.data.reserve(size + 8);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      const float* pixel = match.at(wrapped(x - margin, match.width), wrapped(y - margin, match.height));
      result.data.insert(result.data.end(), pixel, pixel + match.channels);
    }
  result.data.resize(size + 8, 0.0f);
  return result;
}

// Chebyshev distance, wrapped where toroidal.
int apart(const SearchTable& table, Vec2i a, Vec2i b) {
  int x = std::abs(a[0] - b[0]), y = std::abs(a[1] - b[1]);
  if (table.toroidal) x = std::min(x, table.width - x), y = std::min(y, table.height - y);
  return std::max(x, y);
}

// The k windows most similar to centre `self`, in search.best, none within `least` pixels of it or of a
// better one.
void findSimilar(const SearchTable& table, const float* descriptor, std::uint32_t self, int least,
                 TreeSearch& search) {
  std::vector<Found>& best = search.best;
  best.clear();
  const std::size_t count = std::size_t(table.similarCount);
  const Vec2i center = treeCenter(table, self);
  visitNearest(table.tree, descriptor, kSimilarProbes, search, [&](const Found& found) {
    if (best.size() == count && !(found < best.back())) return;
    const Vec2i at = treeCenter(table, found.index);
    if (apart(table, at, center) < least) return;
    const auto near = [&](const Found& other) {
      return apart(table, at, treeCenter(table, other.index)) < least;
    };
    for (const Found& other : best)
      if (near(other) && other < found) return;
    best.erase(std::remove_if(best.begin(), best.end(), near), best.end());
    insertFound(best, count, found);
  });
}

void addSimilar(SearchTable& table, std::span<const float> descriptors) {
  const std::size_t centers = descriptors.size() / kDescriptorSize, count = std::size_t(table.similarCount);
  table.similar.resize(centers * count);
  const int least = std::max(1, table.window / 2);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, centers, 256), [&](const auto& range) {
    TreeSearch search;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      findSimilar(table, descriptors.data() + i * kDescriptorSize, std::uint32_t(i), least, search);
      // Where the leaves hold fewer, the list is filled with the centre itself, a candidate without extra
      // cost.
      for (std::size_t k = 0; k < count; ++k)
        table.similar[i * count + k] =
            treeCenter(table, k < search.best.size() ? search.best[k].index : std::uint32_t(i));
    }
  });
}

}  // namespace

float windowFalloff(int window, float x, float y) {
  const float sigma = float(window) / 3.0f;
  return std::exp(-0.5f * (x * x + y * y) / (sigma * sigma));
}

Vec2i SearchTable::minCenter() const {
  return toroidal ? Vec2i(0, 0) : Vec2i(window / 2, window / 2);
}

Vec2i SearchTable::maxCenter() const {
  return Vec2i(width - 1, height - 1) - minCenter();
}

SearchTable buildSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar) {
  if (window < 1 || window % 2 == 0 || window > std::min(match.width, match.height))
    throw std::invalid_argument("buildSearchTable: a window of " + std::to_string(window) +
                                " pixels in an image of " + std::to_string(match.width) + " x " +
                                std::to_string(match.height));
  SearchTable table;
  table.window = window;
  table.channels = match.channels;
  table.toroidal = toroidal;
  table.width = match.width;
  table.height = match.height;
  table.margin = toroidal ? window / 2 : 0;
  table.padded = padded(match, table.margin);

  const int half = window / 2;
  double sum = 0.0;
  for (int y = -half; y <= half; ++y)
    for (int x = -half; x <= half; ++x) {
      table.falloff.push_back(windowFalloff(window, float(x), float(y)));
      sum += table.falloff.back();
    }
  for (float& value : table.falloff) value = float(value / sum);

  const auto across = [&](int size) { return centersAcross(size, window, toroidal, table.stride); };
  while (std::int64_t(across(match.width)) * across(match.height) > kCenters) ++table.stride;
  const int columns = across(match.width), rows = across(match.height);
  table.basis = windowBasis(table.padded, window, table.falloff, randomBits(seed, 0));
  const std::vector<float> descriptors =
      describeAll(table.basis, table.padded, window, table.stride, columns, rows);
  table.tree = buildWindowTree(descriptors, std::clamp(columns * rows / kWindowsPerLeaf, 1, kLeaves),
                               randomBits(seed, 1));
  table.similarCount = std::max(similar, 0);
  if (similar > 0) addSimilar(table, descriptors);
  return table;
}

WindowQuery::WindowQuery(const SearchTable& table) {
  const std::size_t size = std::size_t(table.window) * std::size_t(table.window);
  pixels.assign(size * std::size_t(table.channels), 0.0f);
  mask.assign(size, 1.0f);
  rows.assign(std::size_t(table.window) * paddedRow(table), 0.0f);
  weight.assign(rows.size(), 0.0f);
  descriptor.assign(kDescriptorSize, 0.0f);
  filled.assign(pixels.size(), 0.0f);
  search.leaf.reserve(64);
  search.best.reserve(256);
}

void prepareQuery(const SearchTable& table, WindowQuery& query) {
  query.described = false;
  query.anyMissing = std::any_of(query.mask.begin(), query.mask.end(), [](float m) { return m != 1.0f; });
  double sum = 0.0;
  if (query.anyMissing)
    for (std::size_t i = 0; i < query.mask.size(); ++i) sum += double(table.falloff[i]) * query.mask[i];
  else
    sum = 1.0;
  const float scale = sum > 0.0 ? float(1.0 / sum) : 0.0f;

  const std::size_t stride = paddedRow(table), channels = std::size_t(table.channels),
                    width = std::size_t(table.window);
  for (std::size_t y = 0; y < width; ++y) {
    float *row = query.rows.data() + y * stride, *weight = query.weight.data() + y * stride;
    std::copy_n(query.pixels.data() + y * width * channels, width * channels, row);
    if (!query.anyMissing && query.fullWeight) continue;
    for (std::size_t x = 0; x < width; ++x) {
      const float m = query.mask[y * width + x];
      std::fill_n(weight + x * channels, channels, table.falloff[y * width + x] * m * scale);
      if (m <= 0.0f) std::fill_n(row + x * channels, channels, 0.0f);
    }
  }
  query.fullWeight = !query.anyMissing;
}

std::span<const float> describeQuery(const SearchTable& table, WindowQuery& query) {
  if (query.described) return query.descriptor;
  query.described = true;
  if (!query.anyMissing) {
    describeWindow(table.basis, query.pixels, query.descriptor);
    return query.descriptor;
  }
  const std::size_t channels = std::size_t(table.channels), stride = paddedRow(table);
  const auto at = [&](std::size_t i, std::size_t c) {
    return i / std::size_t(table.window) * stride + i % std::size_t(table.window) * channels + c;
  };
  // A partly masked pixel is a mixture of its value and the filling.
  const auto fill = [&](std::size_t i, std::size_t c, float missing) {
    const float m = std::clamp(query.mask[i], 0.0f, 1.0f);
    query.filled[i * channels + c] = m * query.rows[at(i, c)] + (1.0f - m) * missing;
  };
  for (std::size_t c = 0; c < channels; ++c) {
    double mean = 0.0;
    for (std::size_t i = 0; i < query.mask.size(); ++i)
      mean += double(query.weight[at(i, c)]) * query.rows[at(i, c)];
    for (std::size_t i = 0; i < query.mask.size(); ++i) fill(i, c, float(mean));
  }
  describeWindow(table.basis, query.filled, query.descriptor);
  reconstructWindow(table.basis, table.falloff, query.descriptor, query.filled);
  for (std::size_t i = 0; i < query.mask.size(); ++i)
    for (std::size_t c = 0; c < channels; ++c) fill(i, c, query.filled[i * channels + c]);
  describeWindow(table.basis, query.filled, query.descriptor);
  return query.descriptor;
}

Vec2i validCenter(const SearchTable& table, Vec2i center) {
  if (table.toroidal) return {wrapped(center[0], table.width), wrapped(center[1], table.height)};
  const Vec2i low = table.minCenter(), high = table.maxCenter();
  return {std::clamp(center[0], low[0], high[0]), std::clamp(center[1], low[1], high[1])};
}

float windowDistance(const SearchTable& table, const WindowQuery& query, Vec2i center, float bound) {
  constexpr int kRowsBetweenTests = 4;
  const int half = table.window / 2;
  const std::size_t size = paddedRow(table);
  const float* corner = table.padded.at(center[0] - half + table.margin, center[1] - half + table.margin);
  const std::size_t imageRow = std::size_t(table.padded.width) * std::size_t(table.channels);
  Float8 even{}, odd{};
  // From the middle row outwards: the fall-off makes the sum pass the bound soonest that way.
  for (int i = 0; i < table.window; ++i) {
    const std::size_t y = std::size_t(i % 2 == 1 ? half - (i + 1) / 2 : half + i / 2);
    const float *image = corner + y * imageRow, *row = query.rows.data() + y * size,
                *weight = query.weight.data() + y * size;
    std::size_t x = 0;
    for (; x + 16 <= size; x += 16) {
      const Float8 a = load8(image + x) - load8(row + x), b = load8(image + x + 8) - load8(row + x + 8);
      even += load8(weight + x) * (a * a);
      odd += load8(weight + x + 8) * (b * b);
    }
    if (x < size) {
      const Float8 a = load8(image + x) - load8(row + x);
      even += load8(weight + x) * (a * a);
    }
    if (i % kRowsBetweenTests == kRowsBetweenTests - 1) {
      const float sum = sum8(even + odd);
      if (sum > bound) return sum;
    }
  }
  return sum8(even + odd);
}

int searchTree(const SearchTable& table, WindowQuery& query, int probes, std::span<Match> best) {
  searchWindowTree(table.tree, describeQuery(table, query).data(), probes, int(best.size()), query.search);
  int count = 0;
  for (const Found& found : query.search.best)
    best[std::size_t(count++)] = {treeCenter(table, found.index), found.distance};
  return count;
}

int similarWindows(const SearchTable& table, Vec2i center, std::span<Vec2i> out) {
  if (table.similar.empty()) return 0;
  const int columns = centersAcross(table.width, table.window, table.toroidal, table.stride);
  const int rows = centersAcross(table.height, table.window, table.toroidal, table.stride);
  const Vec2i steps = (center - table.minCenter());
  const int column = std::min((steps[0] + table.stride / 2) / table.stride, columns - 1);
  const int row = std::min((steps[1] + table.stride / 2) / table.stride, rows - 1);
  const Vec2i remainder = steps - Vec2i(column, row) * table.stride;
  const std::size_t first =
      (std::size_t(row) * std::size_t(columns) + std::size_t(column)) * std::size_t(table.similarCount);
  const std::size_t count = std::min(out.size(), std::size_t(table.similarCount));
  for (std::size_t k = 0; k < count; ++k) out[k] = validCenter(table, table.similar[first + k] + remainder);
  return int(count);
}

Match nearestWindow(const SearchTable& table, WindowQuery& query, std::span<const Vec2i> candidates,
                    int probes, int keep) {
  Match best;
  best.center = table.minCenter();
  const auto compare = [&](Vec2i center) {
    const float distance = windowDistance(table, query, center, best.distance);
    if (distance < best.distance) best = {center, distance};
  };
  if (!candidates.empty()) {
    best.center = validCenter(table, candidates[0]);
    best.distance = windowDistance(table, query, best.center);
    for (const Vec2i& candidate : candidates.subspan(1)) compare(validCenter(table, candidate));
  }
  if (probes < 1) return best;

  searchWindowTree(table.tree, describeQuery(table, query).data(), probes, keep, query.search);
  for (const Found& found : query.search.best) {
    // Descriptor distances ascend and are lower bounds.
    if (!query.anyMissing && found.distance > best.distance) break;
    compare(treeCenter(table, found.index));
  }
  // Because of the descriptors' error and the stride, the best window often lies one step from those found.
  const Vec2i middle = best.center;
  const int reach = std::max(1, table.stride / 2);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if (x != 0 || y != 0) compare(validCenter(table, middle + Vec2i(x, y)));
  return best;
}

}  // namespace fluidtex::texture
