// Based on: N. Halko, P. G. Martinsson, J. A. Tropp, "Finding structure with randomness: probabilistic
// algorithms for constructing approximate matrix decompositions", SIAM Review 53(2), 2011 (subspace
// iteration, algorithm 4.4).
//
// No n x n covariance is ever formed: n is 5,445 for 33 x 33 windows of five channels.
#define EIGEN_DONT_PARALLELIZE  // the order of sums must not depend on the number of threads

#include "texture/search/pca.h"

#include "numerics/lanes.h"
#include "numerics/random.h"
#include "texture/exemplar/principal_axes.h"

#include <tbb/parallel_for.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

constexpr int kRowsSampled = 1536;
constexpr int kOversampling = 8;  // extra columns, as advised there
constexpr int kIterations = 3;
constexpr int kRowsAtOnce = 128;  // rows of a product per task

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Eigen::Index;
using Eigen::MatrixXf;

// body(first, count) for each block of rows.
template <class Body>
void overRows(Index rows, const Body& body) {
  const Index blocks = (rows + kRowsAtOnce - 1) / kRowsAtOnce;
  tbb::parallel_for(Index(0), blocks, [&](Index block) {
    const Index first = block * kRowsAtOnce;
    body(first, std::min<Index>(kRowsAtOnce, rows - first));
  });
}

// The sampled windows, one per row, unweighted, with their mean.
RowMatrix sampleWindows(const Image& image, int window, std::uint64_t seed) {
  const Index columns = image.width - window + 1, all = columns * (image.height - window + 1);
  const Index count = std::min<Index>(kRowsSampled, all);
  const Index rowSize = Index(window) * image.channels;
  RowMatrix windows(count, rowSize * window);
  overRows(count, [&](Index first, Index n) {
    for (Index s = first; s < first + n; ++s) {
      // Stratified: one at random in each of `count` equal intervals, so that no part of the image is missed.
      const Index low = s * all / count, high = (s + 1) * all / count;
      const Index at = low + Index(randomBelow(seed, std::uint64_t(s), std::uint64_t(high - low)));
      for (int y = 0; y < window; ++y)
        std::copy_n(image.at(int(at % columns), int(at / columns) + y), rowSize,
                    windows.data() + s * windows.cols() + y * rowSize);
    }
  });
  return windows;
}

MatrixXf gaussianMatrix(Index rows, Index columns, std::uint64_t seed) {
  MatrixXf matrix(rows, columns);
  for (Index i = 0; i < matrix.size(); ++i) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - randomUnit(seed, 2 * std::uint64_t(i))));
    matrix.data()[i] = float(radius * std::cos(2.0 * M_PI * randomUnit(seed, 2 * std::uint64_t(i) + 1)));
  }
  return matrix;
}

MatrixXf product(const RowMatrix& a, const MatrixXf& b) {
  MatrixXf result(a.rows(), b.cols());
  overRows(a.rows(),
           [&](Index first, Index n) { result.middleRows(first, n).noalias() = a.middleRows(first, n) * b; });
  return result;
}

MatrixXf transposedProduct(const RowMatrix& a, const MatrixXf& b) {
  MatrixXf result(a.cols(), b.cols());
  overRows(a.cols(), [&](Index first, Index n) {
    result.middleRows(first, n).noalias() = a.middleCols(first, n).transpose() * b;
  });
  return result;
}

}  // namespace

WindowBasis windowBasis(const Image& image, int window, std::span<const float> weight, std::uint64_t seed) {
  const Index pixels = Index(window) * window, n = pixels * image.channels;
  RowMatrix windows = sampleWindows(image, window, seed);
  const Index count = windows.rows();

  WindowBasis basis;
  basis.size = int(n);
  basis.mean.resize(std::size_t(n));
  std::vector<float> root(std::size_t(n), 0.0f);
  overRows(n, [&](Index first, Index block) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(block);
    for (Index s = 0; s < count; ++s) sum += windows.row(s).segment(first, block).transpose().cast<double>();
    for (Index i = 0; i < block; ++i) {
      basis.mean[std::size_t(first + i)] = float(sum[i] / double(count));
      root[std::size_t(first + i)] = std::sqrt(weight[std::size_t((first + i) / image.channels)]);
    }
  });
  const Eigen::Map<const Eigen::RowVectorXf> mean(basis.mean.data(), n), scale(root.data(), n);
  overRows(count, [&](Index first, Index block) {
    for (Index s = first; s < first + block; ++s)
      windows.row(s) = (windows.row(s) - mean).cwiseProduct(scale);
  });

  // The range of windows^T, then the principal axes within it.
  const Index rank = std::min<Index>({kDescriptorSize + kOversampling, n, count});
  MatrixXf q = orthonormal(
      transposedProduct(windows, gaussianMatrix(count, rank, randomBits(seed, ~std::uint64_t(0)))));
  for (int iteration = 0; iteration < kIterations; ++iteration)
    q = orthonormal(transposedProduct(windows, product(windows, q)));
  const MatrixXf inside = product(windows, q);
  const PrincipalAxes axes = principalAxes((inside.transpose() * inside).cast<double>());

  // Directions due to rounding alone are left out.
  basis.component.assign(std::size_t(n) * kDescriptorSize, 0.0f);
  Eigen::Map<RowMatrix> component(basis.component.data(), n, kDescriptorSize);
  const double least = 1e-10 * axes.variance[0];
  for (Index k = 0; k < std::min<Index>(kDescriptorSize, rank); ++k)
    if (axes.variance[k] > least)
      component.col(k) = scale.transpose().cwiseProduct(q * axes.axis.col(k).cast<float>());

  basis.offset.assign(kDescriptorSize, 0.0f);
  std::vector<float> offset(kDescriptorSize);
  describeWindow(basis, basis.mean, offset);
  basis.offset = offset;
  return basis;
}

void describeWindow(const WindowBasis& basis, std::span<const float> pixels, std::span<float> descriptor) {
  static_assert(kDescriptorSize == 24);
  // Three registers hold a sum; two sums hide the latency of the additions.
  Float8 sum[2][3] = {};
  const float* row = basis.component.data();
  const auto add = [&](Float8(&to)[3], float pixel) {
    for (int k = 0; k < 3; ++k) to[k] += pixel * load8(row + 8 * k);
    row += kDescriptorSize;
  };
  std::size_t i = 0;
  for (; i + 1 < pixels.size(); i += 2) {
    add(sum[0], pixels[i]);
    add(sum[1], pixels[i + 1]);
  }
  if (i < pixels.size()) add(sum[0], pixels[i]);
  for (int k = 0; k < 3; ++k)
    store8(descriptor.data() + 8 * k, sum[0][k] + sum[1][k] - load8(basis.offset.data() + 8 * k));
}

void reconstructWindow(const WindowBasis& basis, std::span<const float> weight,
                       std::span<const float> descriptor, std::span<float> pixels) {
  const std::size_t channels = pixels.size() / weight.size();
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    float sum = 0.0f;
    for (std::size_t k = 0; k < kDescriptorSize; ++k)
      sum += descriptor[k] * basis.component[i * kDescriptorSize + k];
    pixels[i] = basis.mean[i] + sum / weight[i / channels];
  }
}

std::vector<float> describeAll(const WindowBasis& basis, const Image& image, int window, int stride,
                               int columns, int rows) {
  std::vector<float> descriptors(std::size_t(columns) * std::size_t(rows) * kDescriptorSize);
  const Index rowSize = Index(window) * image.channels;
  const Eigen::Map<const MatrixXf> component(basis.component.data(), kDescriptorSize, basis.size);
  const Eigen::Map<const Eigen::VectorXf> offset(basis.offset.data(), kDescriptorSize);
  tbb::parallel_for(0, rows, [&](int j) {
    Eigen::Map<MatrixXf> result(descriptors.data() + std::size_t(j) * std::size_t(columns) * kDescriptorSize,
                                kDescriptorSize, columns);
    result.colwise() = -offset;
    for (int y = 0; y < window; ++y) {
      // Neighbouring windows overlap, and so do the columns of this matrix: it is a view of the image's row.
      const Eigen::Map<const MatrixXf, 0, Eigen::OuterStride<>> windows(
          image.at(0, j * stride + y), rowSize, columns,
          Eigen::OuterStride<>(Index(stride) * image.channels));
      result.noalias() += component.middleCols(y * rowSize, rowSize) * windows;
    }
  });
  return descriptors;
}

}  // namespace fluidtex::texture
