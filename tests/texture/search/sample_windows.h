// Windows to search for, read from an exemplar.
#pragma once

#include "tests/texture/exemplar/sample_images.h"
#include "texture/search/search.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::testing {

inline Vec2i randomCenter(const SearchTable& table, std::uint64_t seed, std::uint64_t counter) {
  const Vec2i low = table.minCenter(), high = table.maxCenter();
  return low + Vec2i(int(randomBelow(seed, 2 * counter, std::uint64_t(high[0] - low[0] + 1))),
                     int(randomBelow(seed, 2 * counter + 1, std::uint64_t(high[1] - low[1] + 1))));
}

// Reads the window around `center`, its pixels moved by `turn` (an angle) and `stretch`, into the query.
inline void readWindow(const SearchTable& table, const Image& image, Vec2f center, float turn, float stretch,
                       WindowQuery& query) {
  const int half = table.window / 2;
  for (int y = -half; y <= half; ++y)
    for (int x = -half; x <= half; ++x) {
      const Vec2f texel(center[0] + (std::cos(turn) * float(x) - std::sin(turn) * float(y)) / stretch,
                        center[1] + (std::sin(turn) * float(x) + std::cos(turn) * float(y)) * stretch);
      sampleBilinear(image, table.toroidal, texel,
                     query.pixels.data() + ((y + half) * table.window + x + half) * table.channels);
    }
}

inline void readWindow(const SearchTable& table, const Image& image, Vec2i center, WindowQuery& query) {
  readWindow(table, image, Vec2f(float(center[0]), float(center[1])), 0.0f, 1.0f, query);
  std::fill(query.mask.begin(), query.mask.end(), 1.0f);
  prepareQuery(table, query);
}

enum class Kind { turned, stretched, noisy, blended, blurred };

// Windows such as synthesis asks for: none is in the exemplar, all are made from it.
inline void makeQuery(const SearchTable& table, const Image& image, Kind kind, std::uint64_t counter,
                      WindowQuery& query) {
  const Vec2i at = randomCenter(table, 31, counter), other = randomCenter(table, 32, counter);
  const Vec2f center{float(at[0]) + 0.3f, float(at[1]) - 0.4f};
  std::fill(query.mask.begin(), query.mask.end(), 1.0f);
  readWindow(table, image, center, kind == Kind::turned ? 0.3f : 0.0f, kind == Kind::stretched ? 1.3f : 1.0f,
             query);
  if (kind == Kind::noisy)
    for (std::size_t i = 0; i < query.pixels.size(); ++i)
      query.pixels[i] += 0.1f * float(randomUnit(counter + 100, i) - 0.5);
  if (kind == Kind::blended) {
    const std::vector<float> first = query.pixels;
    readWindow(table, image, Vec2f(float(other[0]), float(other[1])), 0.0f, 1.0f, query);
    for (std::size_t i = 0; i < first.size(); ++i) query.pixels[i] = 0.6f * first[i] + 0.4f * query.pixels[i];
  }
  if (kind == Kind::blurred) {
    const std::vector<float> sharp = query.pixels;
    std::vector<float> moved(sharp.size());
    for (const float dx : {-1.5f, 1.5f}) {
      readWindow(table, image, center + Vec2f(dx, 0.7f * dx), 0.0f, 1.0f, query);
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += query.pixels[i];
    }
    for (std::size_t i = 0; i < sharp.size(); ++i) query.pixels[i] = (sharp[i] + moved[i]) / 3.0f;
  }
  prepareQuery(table, query);
}

}  // namespace fluidtex::testing
