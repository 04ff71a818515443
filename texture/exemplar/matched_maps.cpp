// Principal components in place of many channels: S. Lefebvre, H. Hoppe, "Appearance-space texture
// synthesis", ACM Trans. Graph. 25(3), 2006, sec. 3.
#include "texture/exemplar/matched_maps.h"

#include "texture/exemplar/principal_axes.h"
#include "texture/exemplar/texel_place.h"

#include <tbb/parallel_for.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace fluidtex::texture {
namespace {

// Below this variance the colours are plain, and no measure for maps.
constexpr double kLeastColorVariance = 3 * 0.02 * 0.02;
// A map's variance below this share of its mean square is rounding.
constexpr double kRounding = 1e-10;
// Least share of the variance that is worth a channel.
constexpr double kLeastShare = 1e-4;

std::size_t pixelsOf(const Image& image) {
  return std::size_t(image.width) * std::size_t(image.height);
}

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

// Means of the channels, pixels weighted by weight(pixel).
template <typename Weight>
Moments momentsOf(const Image& image, const Weight& weight) {
  const auto channels = std::size_t(image.channels);
  Moments result{Eigen::VectorXd::Zero(image.channels),
                 Eigen::MatrixXd::Zero(image.channels, image.channels)};
  double all = 0.0;
  for (std::size_t i = 0; i < pixelsOf(image); ++i) {
    const double w = weight(i);
    all += w;
    for (std::size_t c = 0; c < channels; ++c)
      result.mean[Eigen::Index(c)] += w * image.data[i * channels + c];
  }
  result.mean /= std::max(all, 1e-12);
  std::vector<double> off(channels);
  for (std::size_t i = 0; i < pixelsOf(image); ++i) {
    const double w = weight(i);
    for (std::size_t c = 0; c < channels; ++c)
      off[c] = image.data[i * channels + c] - result.mean[Eigen::Index(c)];
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t d = 0; d <= c; ++d)
        result.covariance(Eigen::Index(c), Eigen::Index(d)) += w * off[c] * off[d];
  }
  result.covariance /= std::max(all, 1e-12);
  result.covariance = result.covariance.selfadjointView<Eigen::Lower>();
  return result;
}

// Value of the map at a vertex that shows a texel's centre.
Image readAtTexels(const Image& map, const Image& color, bool toroidal) {
  if (map.width == color.width && map.height == color.height) return map;
  const TexelToImage toMap(color.width, color.height, map);
  Image result{color.width, color.height, map.channels, {}};
  result.data.resize(pixelsOf(color) * std::size_t(map.channels));
  tbb::parallel_for(0, color.height, [&](int y) {
    for (int x = 0; x < color.width; ++x)
      sampleCubic(map, toroidal, toMap({float(x), float(y)}), result.at(x, y));
  });
  return result;
}

// Channels of all maps with a weight, centred and scaled.
Image weighted(const std::map<std::string, ExemplarMap>& maps, const Image& color, double colorVariance,
               bool toroidal) {
  const auto alpha = [&](std::size_t i) { return double(color.data[4 * i + 3]); };
  std::vector<Image> parts;
  Image all{color.width, color.height, 0, {}};
  for (const auto& [name, map] : maps) {
    if (!(map.weight > 0.0f)) continue;
    if (map.holds != MapHolds::values)
      throw std::invalid_argument("matchedMaps: " + name + " holds vectors, which turn with the texture");
    if (map.image.data.empty()) throw std::invalid_argument("matchedMaps: " + name + " has no pixels");
    Image part = readAtTexels(map.image, color, toroidal);
    const Moments moments = momentsOf(part, alpha);
    const double variance = moments.covariance.trace();
    if (!(variance > kRounding * (moments.mean.squaredNorm() + variance))) continue;
    // The variance over all texels, transparent ones counting 0, becomes weight times the colours'.
    double seen = 0.0;
    for (std::size_t i = 0; i < pixelsOf(color); ++i) seen += alpha(i) * alpha(i);
    const double scale = std::sqrt(map.weight * colorVariance / (variance * seen / double(pixelsOf(color))));
    const auto channels = std::size_t(part.channels);
    for (std::size_t i = 0; i < part.data.size(); ++i)
      part.data[i] =
          float((part.data[i] - moments.mean[Eigen::Index(i % channels)]) * scale * alpha(i / channels));
    all.channels += part.channels;
    parts.push_back(std::move(part));
  }
  all.data.reserve(pixelsOf(color) * std::size_t(all.channels));
  for (int y = 0; y < all.height; ++y)
    for (int x = 0; x < all.width; ++x)
      for (const Image& part : parts)
        all.data.insert(all.data.end(), part.at(x, y), part.at(x, y) + part.channels);
  return all;
}

}  // namespace

MatchedMaps matchedMaps(const std::map<std::string, ExemplarMap>& maps, const Image& color,
                        const Image& encoded, bool toroidal, int most) {
  if (most < 1) throw std::invalid_argument("matchedMaps: there is no channel for them");
  const auto once = [](std::size_t) { return 1.0; };
  const double colors = std::max(momentsOf(encoded, once).covariance.trace(), kLeastColorVariance);
  const Image all = weighted(maps, color, colors, toroidal);
  if (all.channels == 0) return {};

  const PrincipalAxes principal = principalAxes(momentsOf(all, once).covariance);
  const Eigen::VectorXd& held = principal.variance;
  const double sum = held.sum();
  int count = 0;
  while (count < std::min(most, all.channels) && held[count] > kLeastShare * sum) ++count;
  Eigen::MatrixXd axes = principal.axis.leftCols(count);
  for (Eigen::Index k = 0; k < axes.cols(); ++k) {
    Eigen::Index largest = 0;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0.0) axes.col(k) *= -1.0;  // the solver's choice of sign is arbitrary
  }
  MatchedMaps result{{color.width, color.height, count, {}}, held.head(count).sum() / sum};
  result.image.data.resize(pixelsOf(color) * std::size_t(count));
  tbb::parallel_for(0, color.height, [&](int y) {
    for (int x = 0; x < color.width; ++x)
      for (int k = 0; k < count; ++k) {
        double value = 0.0;
        for (int c = 0; c < all.channels; ++c) value += axes(c, k) * all.at(x, y)[c];
        result.image.at(x, y)[k] = float(value);
      }
  });
  return result;
}

}  // namespace fluidtex::texture
