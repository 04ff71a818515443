#include "texture/measure/patches.h"

#include "texture/exemplar/principal_axes.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace fluidtex::texture {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Row = Eigen::RowVectorXf;

constexpr int kLevels = 3;
constexpr std::array<int, 2> kWidths{7, 15};
constexpr int kDraws = 2;        // of patches, whose distances are averaged
constexpr double kLeast = 0.02;  // a self-distance below is no measure

// Rows of width x width patches; none where the pictures are smaller.
Matrix drawPatches(const Stack& stack, int width, int count, Dice& dice) {
  if (stack.height < width || stack.width < width) return {};
  const int row = width * stack.channels;
  Matrix patches(count, width * row);
  for (int i = 0; i < count; ++i) {
    const int t = int(dice.below(std::uint64_t(stack.count)));
    const int y = int(dice.below(std::uint64_t(stack.height - width + 1)));
    const int x = int(dice.below(std::uint64_t(stack.width - width + 1)));
    for (int j = 0; j < width; ++j)
      std::copy_n(stack.at(t, y + j, x), row, patches.data() + (Eigen::Index(i) * width + j) * row);
  }
  return patches;
}

// Principal components of rows, strongest first: variances and, as columns, directions.
struct Components {
  Row mean;
  Eigen::VectorXd variance;
  Matrix direction;
  double total = 0.0;  // variance, of all there are
};

// The first `kept`, by subspace iteration.
Components componentsOf(const Matrix& rows, Eigen::Index kept) {
  constexpr int kIterations = 8;
  constexpr Eigen::Index kBeside = 16;  // directions carried along to sharpen the others
  Components result;
  result.mean = rows.colwise().mean();
  const Matrix centred = rows.rowwise() - result.mean;
  const Eigen::MatrixXf covariance = centred.transpose() * centred / float(rows.rows());
  result.total = covariance.diagonal().cast<double>().sum();
  const Eigen::Index size = covariance.rows(), carried = std::min(kept + kBeside, size);
  Dice dice(1);
  Eigen::MatrixXf basis(size, carried);
  for (float& entry : basis.reshaped()) entry = float(dice.normal());
  for (int i = 0; i < kIterations; ++i) {
    basis = covariance * orthonormal(basis);
  }
  basis = orthonormal(basis);
  const PrincipalAxes within = principalAxes((basis.transpose() * covariance * basis).cast<double>());
  kept = std::min(kept, size);
  result.variance = within.variance.head(kept);
  result.direction = (basis * within.axis.cast<float>()).leftCols(kept);
  return result;
}

// Half the size: blurred by 0.85 texels, every other one taken.
Stack halved(const Stack& from) {
  constexpr double kBlur = 0.85;
  constexpr int kReach = 3;
  std::array<float, 2 * kReach + 1> weight;
  double sum = 0.0;
  for (int i = -kReach; i <= kReach; ++i) sum += std::exp(-0.5 * i * i / (kBlur * kBlur));
  for (int i = -kReach; i <= kReach; ++i)
    weight[std::size_t(i + kReach)] = float(std::exp(-0.5 * i * i / (kBlur * kBlur)) / sum);
  const int height = (from.height + 1) / 2, width = (from.width + 1) / 2, channels = from.channels;
  Stack rows(from.count, height, from.width, channels), to(from.count, height, width, channels);
  const auto blur = [&](const Stack& source, Stack& target, bool down) {
    for (int t = 0; t < target.count; ++t)
      for (int y = 0; y < target.height; ++y)
        for (int x = 0; x < target.width; ++x)
          for (int i = -kReach; i <= kReach; ++i) {
            const int sy = down ? std::clamp(2 * y + i, 0, source.height - 1) : y;
            const int sx = down ? x : std::clamp(2 * x + i, 0, source.width - 1);
            const float* in = source.at(t, sy, sx);
            for (int c = 0; c < channels; ++c)
              target.at(t, y, x)[c] += weight[std::size_t(i + kReach)] * in[c];
          }
  };
  blur(from, rows, true);
  blur(rows, to, false);
  return to;
}

}  // namespace

std::vector<Stack> pyramidOf(Stack stack) {
  std::vector<Stack> levels;
  levels.push_back(std::move(stack));
  while (int(levels.size()) < kLevels &&
         std::min(levels.back().height, levels.back().width) >= 2 * kWidths.front())
    levels.push_back(halved(levels.back()));
  return levels;
}

// Directions: components, half whitened so that fine detail counts beside mean colour; mixtures of three of
// them; and the norm of the residual that no component explains.
struct PatchJudge::Space {
  static constexpr int kKept = 64, kMixtures = 128;
  Row mean, scale;
  Matrix basis, mixtures;
  float restScale = 1.0f;
  Matrix slices;  // of the reference, each row sorted

  Space(const Matrix& patches, Dice& dice) {
    const Components components = componentsOf(patches, kKept);
    mean = components.mean;
    const Eigen::VectorXd& variance = components.variance;
    const double total = std::max(components.total, 1e-12);
    Eigen::Index explained = 0;
    for (double sum = 0.0; explained < variance.size() && sum < 0.995 * total; ++explained)
      sum += variance[explained];
    const Eigen::Index kept =
        std::min({Eigen::Index(kKept), std::max(Eigen::Index(8), explained), variance.size()});
    basis = components.direction.leftCols(kept);
    const Eigen::ArrayXd deviation = (variance.head(kept).array() + 1e-5 * variance[0] + 1e-12).sqrt();
    scale = (std::sqrt(deviation[0]) / deviation.sqrt() / deviation[0]).cast<float>().matrix().transpose();
    restScale = float(1.0 / deviation[0]);
    mixtures = Matrix::Zero(kept, kMixtures);
    for (int m = 0; m < kMixtures; ++m) {
      for (int chosen = 0; chosen < std::min<int>(3, int(kept));) {
        float& entry = mixtures(Eigen::Index(dice.below(std::uint64_t(kept))), m);
        if (entry != 0.0f) continue;
        entry = float(dice.normal());
        ++chosen;
      }
      mixtures.col(m).normalize();
    }
    slices = sortedSlices(patches);
  }

  Matrix sortedSlices(const Matrix& patches) const {
    const Matrix centred = patches.rowwise() - mean;
    Matrix along = centred * basis;
    const Eigen::VectorXf rest =
        (centred.rowwise().squaredNorm() - along.rowwise().squaredNorm()).cwiseMax(0.0f).cwiseSqrt();
    along = along.array().rowwise() * scale.array();
    Matrix result(along.cols() + mixtures.cols() + 1, patches.rows());
    result.topRows(along.cols()) = along.transpose();
    result.middleRows(along.cols(), mixtures.cols()) = (along * mixtures).transpose();
    result.bottomRows(1) = rest.transpose() * restScale;
    for (Eigen::Index r = 0; r < result.rows(); ++r)
      std::sort(result.row(r).data(), result.row(r).data() + result.cols());
    return result;
  }
};

PatchJudge::PatchJudge(const std::vector<Stack>& reference, int patches, Dice& dice) : m_patches(patches) {
  for (int level = 0; level < int(reference.size()); ++level)
    for (const int width : kWidths) {
      const Matrix drawn = drawPatches(reference[std::size_t(level)], width, patches, dice);
      if (drawn.rows() > 0) m_spaces[{level, width}] = std::make_shared<Space>(drawn, dice);
    }
}

PatchDistances PatchJudge::distances(const std::vector<Stack>& pyramid, Dice& dice) const {
  PatchDistances result;
  for (const auto& [key, space] : m_spaces) {
    if (key.first >= int(pyramid.size())) continue;
    for (int draw = 0; draw < kDraws; ++draw) {
      const Matrix drawn = drawPatches(pyramid[std::size_t(key.first)], key.second, m_patches, dice);
      if (drawn.rows() == 0) break;
      const double square = (space->slices - space->sortedSlices(drawn)).array().square().mean();
      result[key] += std::sqrt(square) / kDraws;
    }
  }
  return result;
}

double patchRatio(const PatchDistances& distances, const std::vector<PatchDistances>& own) {
  double sum = 0.0;
  int terms = 0;
  for (const auto& [key, distance] : distances) {
    double mean = 0.0;
    for (const PatchDistances& one : own) mean += one.contains(key) ? one.at(key) / double(own.size()) : 0.0;
    sum += distance / std::max(mean, kLeast);
    ++terms;
  }
  return terms > 0 ? sum / terms : 0.0;
}

struct CoverageMap::Internals {
  static constexpr int kWidth = 9, kParts = 8, kTurns = 8, kEach = 4000, kKept = 24, kDrawn = 5000;
  Row mean;
  Matrix basis, known;    // known: the exemplar's patches, reduced
  Eigen::VectorXf half;   // of their squared lengths
  std::vector<int> part;  // that each comes from
};

CoverageMap::CoverageMap(const Image& encoded, Dice& dice) : m_internals(std::make_shared<Internals>()) {
  using In = Internals;
  Image picture = encoded;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) toPerceptual(picture.at(x, y), picture.channels);
  constexpr int kReach = In::kWidth / 2;
  Matrix patches(In::kTurns * In::kEach, In::kWidth * In::kWidth * picture.channels);
  const auto within = [&](int size) {
    return In::kWidth + dice.unit() * std::max(size - 1.0 - 2.0 * In::kWidth, 0.0);
  };
  for (Eigen::Index i = 0; i < patches.rows(); ++i) {
    const Eigen::Index turn = i / In::kEach;
    const double angle = 2.0 * std::numbers::pi * double(turn) / In::kTurns;
    const double c = std::cos(angle), s = std::sin(angle), x = within(picture.width),
                 y = within(picture.height);
    float* out = patches.row(i).data();
    for (int oy = -kReach; oy <= kReach; ++oy)
      for (int ox = -kReach; ox <= kReach; ++ox, out += picture.channels)
        sampleMirrored(picture, x + c * ox - s * oy, y + s * ox + c * oy, out);
    const auto part = [](double at, int size) {
      return std::clamp(int(at * In::kParts / size), 0, In::kParts - 1);
    };
    m_internals->part.push_back(part(y, picture.height) * In::kParts + part(x, picture.width));
  }
  Matrix sample(3000, patches.cols());
  for (Eigen::Index i = 0; i < sample.rows(); ++i)
    sample.row(i) = patches.row(Eigen::Index(dice.below(std::uint64_t(patches.rows()))));
  m_internals->mean = patches.colwise().mean();
  m_internals->basis = componentsOf(sample, In::kKept).direction;
  m_internals->known = (patches.rowwise() - m_internals->mean) * m_internals->basis;
  m_internals->half = 0.5f * m_internals->known.rowwise().squaredNorm();
}

double CoverageMap::effectiveParts(const Stack& stack, Dice& dice) const {
  const Internals& in = *m_internals;
  const Matrix drawn = drawPatches(stack, Internals::kWidth, Internals::kDrawn, dice);
  const Matrix reduced = (drawn.rowwise() - in.mean) * in.basis;
  std::vector<double> share(Internals::kParts * Internals::kParts, 0.0);
  constexpr Eigen::Index kChunk = 128;
  for (Eigen::Index begin = 0; begin < reduced.rows(); begin += kChunk) {
    const Eigen::Index rows = std::min(kChunk, reduced.rows() - begin);
    const Matrix product = reduced.middleRows(begin, rows) * in.known.transpose();
    for (Eigen::Index i = 0; i < rows; ++i) {
      Eigen::Index nearest = 0;
      (in.half.transpose() - product.row(i)).minCoeff(&nearest);
      share[std::size_t(in.part[std::size_t(nearest)])] += 1.0 / double(reduced.rows());
    }
  }
  double entropy = 0.0;
  for (const double p : share)
    if (p > 0.0) entropy -= p * std::log(p);
  return std::exp(entropy);
}

Reduced reducedWindows(const std::vector<float>& windows, int dimension) {
  constexpr Eigen::Index kKept = 20, kSample = 2500;
  const Eigen::Map<const Matrix> rows(windows.data(), Eigen::Index(windows.size()) / dimension, dimension);
  const Eigen::Index step = std::max<Eigen::Index>(1, rows.rows() / kSample);
  Matrix sample((rows.rows() + step - 1) / step, dimension);
  for (Eigen::Index i = 0; i < sample.rows(); ++i) sample.row(i) = rows.row(i * step);
  const Matrix basis = componentsOf(sample, kKept).direction;
  const Row mean = rows.colwise().mean();
  const Matrix values = (rows.rowwise() - mean) * basis;
  return {int(basis.cols()), {values.data(), values.data() + values.size()}};
}

double shareWithTwin(const Reduced& windows, int asked,
                     const std::function<bool(std::size_t, std::size_t)>& far) {
  const Eigen::Map<const Matrix> rows(
      windows.values.data(), Eigen::Index(windows.values.size()) / windows.dimension, windows.dimension);
  const Eigen::VectorXf lengths = rows.rowwise().squaredNorm();
  const float tolerance = 0.2f * 0.2f * lengths.mean();
  const Eigen::Index step = std::max<Eigen::Index>(1, rows.rows() / asked);
  int twins = 0, count = 0;
  for (Eigen::Index i = 0; i < rows.rows(); i += step, ++count) {
    const Eigen::VectorXf distances =
        (lengths.array() + lengths[i]).matrix() - 2.0f * (rows * rows.row(i).transpose());
    for (Eigen::Index j = 0; j < rows.rows(); ++j) {
      if (distances[j] >= tolerance || !far(std::size_t(i), std::size_t(j))) continue;
      ++twins;
      break;
    }
  }
  return count > 0 ? double(twins) / count : 0.0;
}

}  // namespace fluidtex::texture
