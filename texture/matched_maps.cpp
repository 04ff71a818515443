// Principal components in place of many channels: S. Lefebvre, H. Hoppe, "Appearance-space texture
// synthesis", ACM Trans. Graph. 25(3), 2006, sec. 3.
#include "texture/matched_maps.h"

#include "texture/texel_place.h"

#include <tbb/parallel_for.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace fluidtex::texture {
namespace {

// Plain colours have no differences that a map's could be measured by: it counts at least as much as colours
// whose channels deviate by a tenth.
constexpr double kLeastColorVariance = 3 * 0.1 * 0.1;

// One row a texel, one column a number.
using Numbers = Eigen::MatrixXf;

// Of all columns together, about their means.
double variance(const Numbers& numbers) {
  const Eigen::MatrixXd centered = numbers.cast<double>().rowwise() - numbers.cast<double>().colwise().mean();
  return centered.squaredNorm() / double(numbers.rows());
}

Numbers numbersOf(const Image& image) {
  Numbers result(Eigen::Index(image.width) * image.height, image.channels);
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    for (int c = 0; c < image.channels; ++c) result(i, c) = image.data[std::size_t(i * image.channels + c)];
  return result;
}

// What a vertex that shows a texel's centre is given of the map.
Numbers readAtTexels(const Image& map, const Image& color, bool toroidal) {
  const TexelToImage toMap(color.width, color.height, map);
  Numbers result(Eigen::Index(color.width) * color.height, map.channels);
  tbb::parallel_for(0, color.height, [&](int y) {
    std::vector<float> value(std::size_t(map.channels));
    for (int x = 0; x < color.width; ++x) {
      sampleCubic(map, toroidal, toMap({float(x), float(y)}), value.data());
      for (int c = 0; c < map.channels; ++c)
        result(Eigen::Index(y) * color.width + x, c) = value[std::size_t(c)];
    }
  });
  return result;
}

// About the mean of what is seen, which takes the place of what is not.
void centerWhereSeen(const Eigen::VectorXf& alpha, Numbers& numbers) {
  const double seen = std::max(alpha.cast<double>().sum(), 1e-12);
  const Eigen::RowVectorXd mean = alpha.cast<double>().transpose() * numbers.cast<double>() / seen;
  numbers.rowwise() -= mean.cast<float>();
  numbers.array().colwise() *= alpha.array();
}

// The first `most` principal components of centred numbers, and the share of the variance that they hold.
std::pair<Numbers, double> reduced(const Numbers& numbers, int most) {
  if (numbers.cols() <= most) return {numbers, 1.0};
  const Eigen::MatrixXd all = numbers.cast<double>();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(all.transpose() * all);  // ascending
  Eigen::MatrixXd axes = solver.eigenvectors().rightCols(most).rowwise().reverse();
  for (Eigen::Index k = 0; k < axes.cols(); ++k) {
    Eigen::Index largest = 0;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0.0) axes.col(k) *= -1.0;  // a solver is free to choose the sign
  }
  const double sum = solver.eigenvalues().cwiseMax(0.0).sum();
  const double held = solver.eigenvalues().tail(most).cwiseMax(0.0).sum();
  return {(all * axes).cast<float>(), sum > 0.0 ? held / sum : 1.0};
}

Image imageOf(const Numbers& numbers, const Image& color) {
  Image result{color.width, color.height, int(numbers.cols()), {}};
  result.data.reserve(std::size_t(numbers.size()));
  for (Eigen::Index i = 0; i < numbers.rows(); ++i)
    for (Eigen::Index c = 0; c < numbers.cols(); ++c) result.data.push_back(numbers(i, c));
  return result;
}

}  // namespace

MatchedMaps matchedMaps(const std::map<std::string, ExemplarMap>& maps, const Image& color,
                        const Image& encoded, bool toroidal, int most) {
  if (most < 1) throw std::invalid_argument("matchedMaps: there is no channel for them");
  Numbers all(Eigen::Index(color.width) * color.height, 0);
  const Eigen::VectorXf alpha = numbersOf(color).col(3);
  const double colors = std::max(variance(numbersOf(encoded)), kLeastColorVariance);
  for (const auto& [name, map] : maps) {
    if (!(map.weight > 0.0f)) continue;
    if (map.holds != MapHolds::values)
      throw std::invalid_argument("matchedMaps: " + name + " holds vectors, which turn with the texture");
    Numbers numbers = readAtTexels(map.image, color, toroidal);
    centerWhereSeen(alpha, numbers);
    const double own = variance(numbers);
    if (!(own > 1e-12)) continue;  // the same everywhere
    const Eigen::Index before = all.cols();
    all.conservativeResize(Eigen::NoChange, before + numbers.cols());
    all.rightCols(numbers.cols()) = float(std::sqrt(map.weight * colors / own)) * numbers;
  }
  if (all.cols() == 0) return {};
  const auto [channels, kept] = reduced(all, most);
  return {imageOf(channels, color), kept};
}

}  // namespace fluidtex::texture
