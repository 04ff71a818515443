// Based on: Jiang and Peng, "Weighted ENO schemes for Hamilton-Jacobi equations", 2000 (space);
// Shu and Osher, "Efficient implementation of essentially non-oscillatory shock-capturing schemes", 1988
// (time).
#include "sim/leaf_table.h"
#include "sim/level_set.h"

#include <openvdb/tools/Morphology.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

constexpr int kHalo = 3;                     // of the fifth-order stencil
constexpr int kSide = kLeafDim + 2 * kHalo;  // 14
constexpr int kBlock = kSide * kSide * kSide;

// The upwind WENO5 derivative (times h) from five successive differences, the most upwind one first.
inline float weno5(float v1, float v2, float v3, float v4, float v5) {
  const float a = v1 - 2.0f * v2 + v3, b = v2 - 2.0f * v3 + v4, c = v3 - 2.0f * v4 + v5;
  const float a1 = v1 - 4.0f * v2 + 3.0f * v3, b1 = v2 - v4, c1 = 3.0f * v3 - 4.0f * v4 + v5;
  const float s1 = (13.0f / 12.0f) * a * a + 0.25f * a1 * a1;
  const float s2 = (13.0f / 12.0f) * b * b + 0.25f * b1 * b1;
  const float s3 = (13.0f / 12.0f) * c * c + 0.25f * c1 * c1;
  // phi is divided by h before, so that differences are near 1 and one epsilon fits every grid.
  constexpr float kEpsilon = 1e-6f;
  const float e1 = kEpsilon + s1, e2 = kEpsilon + s2, e3 = kEpsilon + s3;
  // 0.1 / e1^2 : 0.6 / e2^2 : 0.3 / e3^2, with one division below instead of four.
  const float e12 = e1 * e2, e13 = e1 * e3, e23 = e2 * e3;
  const float w1 = 0.1f * e23 * e23, w2 = 0.6f * e13 * e13, w3 = 0.3f * e12 * e12;
  const float p1 = v1 * (1.0f / 3.0f) - v2 * (7.0f / 6.0f) + v3 * (11.0f / 6.0f);
  const float p2 = -v2 * (1.0f / 6.0f) + v3 * (5.0f / 6.0f) + v4 * (1.0f / 3.0f);
  const float p3 = v3 * (1.0f / 3.0f) + v4 * (5.0f / 6.0f) - v5 * (1.0f / 6.0f);
  return (w1 * p1 + w2 * p2 + w3 * p3) / (w1 + w2 + w3);
}

// out = speed * derivative along one axis, added up; block: phi/h with halo; speed in cells per sub-step.
void addAdvection(const float* __restrict block, int stride, const float* __restrict speed,
                  float* __restrict out) {
  for (int i = 0; i < kLeafDim; ++i) {
    for (int j = 0; j < kLeafDim; ++j) {
      const float* p = block + ((i + kHalo) * kSide + j + kHalo) * kSide + kHalo;
      const float* s = speed + 64 * i + 8 * j;
      float* o = out + 64 * i + 8 * j;
      for (int k = 0; k < kLeafDim; ++k) {
        const float m3 = p[k - 3 * stride], m2 = p[k - 2 * stride], m1 = p[k - stride], c = p[k];
        const float p1 = p[k + stride], p2 = p[k + 2 * stride], p3 = p[k + 3 * stride];
        const bool forward = s[k] > 0.0f;
        const float v1 = forward ? m2 - m3 : p3 - p2;
        const float v2 = forward ? m1 - m2 : p2 - p1;
        const float v3 = forward ? c - m1 : p1 - c;
        const float v4 = forward ? p1 - c : c - m1;
        const float v5 = forward ? p2 - p1 : m1 - m2;
        o[k] += s[k] * weno5(v1, v2, v3, v4, v5);
      }
    }
  }
}

// Velocity at cell centres, 3 x 512 floats a leaf, in m/s.
std::vector<float> cellVelocity(const std::vector<FloatLeaf*>& leaves, const Velocity& velocity) {
  std::vector<float> centred(leaves.size() * 3 * kLeafSize);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    constexpr int kOne = kLeafDim + 2;
    float block[kOne * kOne * kOne] = {};
    for (int axis = 0; axis < 3; ++axis) {
      gather(velocity.component[axis]->constTree(), leaves[n]->origin(), 1, block, true);
      const int stride = axis == 0 ? kOne * kOne : (axis == 1 ? kOne : 1);
      float* to = centred.data() + (3 * n + axis) * kLeafSize;
      for (int i = 0; i < kLeafDim; ++i) {
        for (int j = 0; j < kLeafDim; ++j) {
          const float* p = block + ((i + 1) * kOne + j + 1) * kOne + 1;
          for (int k = 0; k < kLeafDim; ++k) to[64 * i + 8 * j + k] = 0.5f * (p[k] + p[k + stride]);
        }
      }
    }
  });
  return centred;
}

// Whether all that a leaf's stencils reach has one value: beyond the band, where nothing moves.
bool isFlat(const float* block) {
  const float value = block[(kHalo * kSide + kHalo) * kSide + kHalo];
  const auto rowIsFlat = [&](int i, int j, int first, int last) {
    const float* row = block + (i * kSide + j) * kSide;
    bool flat = true;
    for (int k = first; k < last; ++k) flat &= row[k] == value;
    return flat;
  };
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const int off = int(i < kHalo || i >= kHalo + kLeafDim) + int(j < kHalo || j >= kHalo + kLeafDim);
      if (off == 2) continue;  // crossOnly: not gathered
      if (!rowIsFlat(i, j, off == 0 ? 0 : kHalo, off == 0 ? kSide : kHalo + kLeafDim)) return false;
    }
  }
  return true;
}

// One Runge-Kutta stage on every leaf: to = a * base + b * (from + dt L(from)), clamped to the band.
// `speed` is velocity * dt / h, `fastest` by leaf 0 where nothing moves. base may be `to`.
void stage(const FloatTree& from, const std::vector<FloatLeaf*>& base, const std::vector<FloatLeaf*>& to,
           float a, float b, const std::vector<float>& speed, const std::vector<float>& fastest, float h,
           float background) {
  tbb::parallel_for(std::size_t{0}, to.size(), [&](std::size_t n) {
    static thread_local float block[kBlock];  // 0 where nothing is gathered
    gather(from, to[n]->origin(), kHalo, block, true);
    const bool still = fastest[n] == 0.0f || isFlat(block);
    const float inverse = 1.0f / h;
    for (float& value : block) value *= inverse;
    float change[kLeafSize] = {};
    const float* s = speed.data() + 3 * n * kLeafSize;
    if (!still) {
      addAdvection(block, kSide * kSide, s, change);
      addAdvection(block, kSide, s + kLeafSize, change);
      addAdvection(block, 1, s + 2 * kLeafSize, change);
    }
    const float* was = base[n]->buffer().data();
    float* out = to[n]->buffer().data();
    for (int i = 0; i < kLeafDim; ++i) {
      for (int j = 0; j < kLeafDim; ++j) {
        const float* p = block + ((i + kHalo) * kSide + j + kHalo) * kSide + kHalo;
        const int row = 64 * i + 8 * j;
        for (int k = 0; k < kLeafDim; ++k) {
          const float next = a * was[row + k] + b * h * (p[k] - change[row + k]);
          // By value, so that the loop vectorises.
          const float above = next > -background ? next : -background;
          out[row + k] = above < background ? above : background;
        }
      }
    }
  });
}

}  // namespace

void advectPhi(FloatGrid& phi, const Velocity& velocity, double dt) {
  const float h = static_cast<float>(phi.voxelSize()[0]);
  const int reach = static_cast<int>(std::ceil(dt * maxAbs(velocity) / h)) + 1;
  openvdb::tools::dilateActiveValues(phi.tree(), reach, openvdb::tools::NN_FACE,
                                     openvdb::tools::EXPAND_TILES);

  const auto leaves = leavesOf(phi.tree());
  std::vector<float> speed = cellVelocity(leaves, velocity);
  // The fastest cell's |u|+|v|+|w|.
  std::vector<float> fastest(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const float* s = speed.data() + 3 * n * kLeafSize;
    for (int i = 0; i < kLeafSize; ++i) {
      fastest[n] =
          std::max(fastest[n], std::abs(s[i]) + std::abs(s[kLeafSize + i]) + std::abs(s[2 * kLeafSize + i]));
    }
  });
  const double most = leaves.empty() ? 0.0 : *std::max_element(fastest.begin(), fastest.end());
  if (most == 0.0) return;
  const int substeps = static_cast<int>(std::floor(dt * most / h)) + 1;
  const float scale = static_cast<float>(dt / substeps / h);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    for (std::size_t i = 3 * n * kLeafSize; i < 3 * (n + 1) * kLeafSize; ++i) speed[i] *= scale;
  });

  FloatTree first(phi.constTree()), second(phi.constTree());
  const auto firstLeaves = leavesOf(first), secondLeaves = leavesOf(second);
  const float background = phi.background();
  for (int n = 0; n < substeps; ++n) {
    stage(phi.constTree(), leaves, firstLeaves, 0.0f, 1.0f, speed, fastest, h, background);
    stage(first, leaves, secondLeaves, 0.75f, 0.25f, speed, fastest, h, background);
    stage(second, leaves, leaves, 1.0f / 3.0f, 2.0f / 3.0f, speed, fastest, h, background);
  }
}

}  // namespace fluidtex::sim
