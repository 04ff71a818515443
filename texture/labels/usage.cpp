#include "texture/labels/usage.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Least expected usage, so that a single use of a part without demand has a finite cost.
constexpr float kLeastAsked = 0.1f;
constexpr int kSamples = 3;  // along a cell's side

}  // namespace

Usage::Usage(const TexelImage& image, int cell, std::size_t count, const Demand& demand)
    : m_toroidal(image.toroidal),
      m_columns(std::max(1, image.width / cell)),
      m_rows(std::max(1, image.height / cell)),
      m_toCell(float(m_columns) / float(image.width), float(m_rows) / float(image.height)),
      m_perMean(float(m_columns * m_rows) / float(std::max<std::size_t>(count, 1))),
      m_count(std::size_t(m_columns) * std::size_t(m_rows), 0.0f) {
  if (demand.empty()) return;
  m_asked.assign(m_count.size(), 0.0f);
  const auto place = [](int index, int sample, float toCell) {
    return (float(index) + (float(sample) + 0.5f) / float(kSamples)) / toCell;
  };
  for (int j = 0; j < m_rows; ++j)
    for (int i = 0; i < m_columns; ++i) {
      float sum = 0.0f;
      for (int y = 0; y < kSamples; ++y)
        for (int x = 0; x < kSamples; ++x)
          sum += demand.at(place(i, x, m_toCell[0]), place(j, y, m_toCell[1]));
      m_asked[std::size_t(j * m_columns + i)] = std::max(kLeastAsked, sum / float(kSamples * kSamples));
    }
}

int Usage::brought(int i, int size) const {
  return m_toroidal ? ((i % size) + size) % size : std::clamp(i, 0, size - 1);
}

template <typename Body>
void Usage::visit(const Vec2f& texel, const Body& body) const {
  const float x = (texel[0] + 0.5f) * m_toCell[0] - 0.5f, y = (texel[1] + 0.5f) * m_toCell[1] - 0.5f;
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const float fx = x - float(i), fy = y - float(j);
  for (int dj = 0; dj < 2; ++dj)
    for (int di = 0; di < 2; ++di)
      body(std::size_t(brought(j + dj, m_rows)) * std::size_t(m_columns) +
               std::size_t(brought(i + di, m_columns)),
           (di ? fx : 1.0f - fx) * (dj ? fy : 1.0f - fy));
}

void Usage::add(const Vec2f& texel, float amount) {
  visit(texel, [&](std::size_t cell, float weight) { m_count[cell] += amount * weight; });
}

float Usage::at(const Vec2f& texel) const {
  float sum = 0.0f, asked = m_asked.empty() ? 1.0f : 0.0f;
  visit(texel, [&](std::size_t cell, float weight) {
    sum += m_count[cell] * weight;
    if (!m_asked.empty()) asked += m_asked[cell] * weight;
  });
  return sum * m_perMean / asked;
}

}  // namespace fluidtex::texture
