#include "texture/exemplar/image.h"

#include "numerics/catmull_rom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Comparisons are written so that NaN reads some texel instead of out of bounds.
float inside(float t, int size, bool toroidal) {
  if (!toroidal) return t > 0.0f ? std::min(t, float(size - 1)) : 0.0f;
  if (t >= 0.0f && t < float(size)) return t;
  t -= float(size) * std::floor(t / float(size));
  return t >= 0.0f && t < float(size) ? t : 0.0f;
}

int neighbor(int i, int size, bool toroidal) {
  if (i >= 0 && i < size) return i;
  return toroidal ? (i % size + size) % size : std::clamp(i, 0, size - 1);
}

}  // namespace

void sampleBilinear(const Image& image, bool toroidal, const Vec2f& texel, float* out) {
  float x = inside(texel[0], image.width, toroidal), y = inside(texel[1], image.height, toroidal);
  const int x0 = int(x), y0 = int(y);
  x -= float(x0), y -= float(y0);
  const int x1 = neighbor(x0 + 1, image.width, toroidal), y1 = neighbor(y0 + 1, image.height, toroidal);
  const float *a = image.at(x0, y0), *b = image.at(x1, y0), *c = image.at(x0, y1), *d = image.at(x1, y1);
  for (int k = 0; k < image.channels; ++k) {
    const float above = a[k] + x * (b[k] - a[k]), below = c[k] + x * (d[k] - c[k]);
    out[k] = above + y * (below - above);
  }
}

namespace {

// read(texel, k): value of channel k to be interpolated.
template <typename Read>
void cubic(const Image& image, bool toroidal, const Vec2f& texel, const Read& read, float* out) {
  const float x = inside(texel[0], image.width, toroidal), y = inside(texel[1], image.height, toroidal);
  const int x0 = int(x), y0 = int(y);
  const auto across = catmullRom(x - float(x0)), down = catmullRom(y - float(y0));
  std::array<int, 4> column;
  std::array<const float*, 4> row;
  for (int i = 0; i < 4; ++i) {
    column[i] = image.channels * neighbor(x0 - 1 + i, image.width, toroidal);
    row[i] = image.at(0, neighbor(y0 - 1 + i, image.height, toroidal));
  }
  for (int k = 0; k < image.channels; ++k) {
    const auto value = [&](int j, int i) { return read(row[j] + column[i], k); };
    float sum = 0.0f;
    for (int j = 0; j < 4; ++j) {
      float along = 0.0f;
      for (int i = 0; i < 4; ++i) along += across[i] * value(j, i);
      sum += down[j] * along;
    }
    const auto [least, most] = std::minmax({value(1, 1), value(1, 2), value(2, 1), value(2, 2)});
    out[k] = std::clamp(sum, least, most);
  }
}

}  // namespace

void sampleCubic(const Image& image, bool toroidal, const Vec2f& texel, float* out) {
  cubic(
      image, toroidal, texel, [](const float* at, int k) { return at[k]; }, out);
}

Vec4f samplePremultiplied(const Image& color, bool toroidal, const Vec2f& texel) {
  Vec4f result;
  cubic(
      color, toroidal, texel, [](const float* at, int k) { return k < 3 ? at[k] * at[3] : at[3]; },
      result.asPointer());
  return result;
}

}  // namespace fluidtex::texture
