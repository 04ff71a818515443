#include "transport/velocity_sampler.h"

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fluidtex::transport {
namespace {

using openvdb::Coord;

// Bits of a leaf's value mask: one 64-bit word per x, bit 8 y + z. These four are (y, z), (y, z+1), (y+1, z),
// (y+1, z+1).
constexpr std::uint64_t kSquare = 0x303;

// How far the corners [4 dx + 2 dy + dz] of a cell lie apart along the axis, and along the other two.
template <int kAxis>
struct Corners {
  static constexpr unsigned kAlong = 4u >> kAxis, kFirst = kAxis == 0 ? 2 : 4, kSecond = kAxis == 2 ? 2 : 1;
};

// Between four values, [2 dFirst + dSecond].
inline double bilinear(double v00, double v01, double v10, double v11, double first, double second) {
  const double v0 = v00 + second * (v01 - v00), v1 = v10 + second * (v11 - v10);
  return v0 + first * (v1 - v0);
}

}  // namespace

VelocitySampler::VelocitySampler(const sim::Substep& substep) {
  const std::array<sim::FloatGrid::ConstPtr, 3> grids{substep.u, substep.v, substep.w};
  double smallest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    Component& component = m_components[axis];
    component.grid = grids[axis];
    if (!component.grid) continue;
    const openvdb::math::Transform& transform = component.grid->transform();
    if (!transform.isLinear()) throw std::invalid_argument("velocity grid: its transform is not linear");
    const Vec3d origin = transform.worldToIndex(Vec3d(0.0));
    for (int j = 0; j < 3; ++j) {
      Vec3d unit(0.0);
      unit[j] = 1.0;
      const Vec3d image = transform.worldToIndex(unit) - origin;
      for (int i = 0; i < 3; ++i) {
        if (i != j && std::abs(image[i]) > 1e-9 * std::abs(image[j])) {
          throw std::invalid_argument("velocity grid: its transform turns or shears");
        }
      }
      component.scale[j] = image[j];
      smallest = std::min(smallest, 1.0 / std::abs(image[j]));
    }
    component.shift = origin;
    component.accessor = std::make_unique<sim::FloatGrid::ConstAccessor>(component.grid->getConstAccessor());
  }
  m_voxelSize = std::isfinite(smallest) ? smallest : 0.0;
}

void VelocitySampler::fetch(Component& component, unsigned which) {
  Leaves& near = component.near;
  const Coord corner =
      near.origin + Coord(8 * (int(which) / 9 - 1), 8 * (int(which) / 3 % 3 - 1), 8 * (int(which) % 3 - 1));
  near.leaf[which] = component.accessor->probeConstLeaf(corner);
  near.values[which] = near.leaf[which] ? near.leaf[which]->buffer().data() : nullptr;
  near.fetched |= 1u << which;
}

// Whether it is active.
inline bool VelocitySampler::value(Component& component, unsigned which, unsigned offset, double& result) {
  Leaves& near = component.near;
  if (!(near.fetched >> which & 1u)) fetch(component, which);
  if (const Leaf* leaf = near.leaf[which]) {
    result = near.values[which][offset];
    return leaf->valueMask().isOn(offset);
  }
  float tile = 0.0f;
  const Coord middle(int(which) / 9 - 1, int(which) / 3 % 3 - 1, int(which) % 3 - 1);
  const bool active = component.accessor->probeValue(near.origin + Coord(8 * middle.x(), 8 * middle.y(), 8 * middle.z()) + Leaf::offsetToLocalCoord(offset), tile);
  result = tile;
  return active;
}

unsigned VelocitySampler::valuesAround(Component& component, const Coord& lower,
                                       std::array<double, 8>& values) {
  Leaves& near = component.near;
  const Coord origin(lower.x() & ~7, lower.y() & ~7, lower.z() & ~7);
  if (origin != near.origin) {
    near.origin = origin;
    near.fetched = 0;
  }
  const unsigned i = lower.x() & 7, j = lower.y() & 7, k = lower.z() & 7;
  if (i < 7 && j < 7 && k < 7) {
    if (!(near.fetched & 1u << 13)) fetch(component, 13);
    if (const Leaf* leaf = near.leaf[13]) {
      const std::uint64_t square = kSquare << (8 * j + k);
      const bool active = (leaf->valueMask().getWord<std::uint64_t>(i) & square) == square &&
                          (leaf->valueMask().getWord<std::uint64_t>(i + 1) & square) == square;
      if (active) {
        const float* corner = near.values[13] + (64 * i + 8 * j + k);
        values = {corner[0], corner[1], corner[8], corner[9], corner[64], corner[65], corner[72], corner[73]};
        return 0xffu;
      }
    }
  }
  // Along each axis the upper values lie in the next leaf if the lower ones are the last of theirs.
  const std::array<unsigned, 2> x{64 * i, 64 * ((i + 1) & 7)}, y{8 * j, 8 * ((j + 1) & 7)}, z{k, (k + 1) & 7};
  const std::array<unsigned, 2> leafX{13, 13 + 9 * ((i + 1) >> 3)}, leafY{0, 3 * ((j + 1) >> 3)},
      leafZ{0, (k + 1) >> 3};
  unsigned active = 0;
#pragma GCC unroll 8
  for (unsigned tap = 0; tap < 8; ++tap) {
    const unsigned dx = tap >> 2, dy = tap >> 1 & 1, dz = tap & 1;
    const unsigned which = leafX[dx] + leafY[dy] + leafZ[dz], offset = x[dx] + y[dy] + z[dz];
    active |= unsigned(value(component, which, offset, values[tap])) << tap;
  }
  return active;
}

// The values around in the plane of voxels that lies `step` along the axis, -1 or 2; whether all are active.
// After valuesAround() of the same voxel.
template <int kAxis>
bool VelocitySampler::valuesBeside(Component& component, const Coord& lower, int step,
                                   std::array<double, 4>& values) {
  constexpr int kFirst = kAxis == 0 ? 1 : 0, kSecond = kAxis == 2 ? 1 : 2;
  constexpr std::array<unsigned, 3> kStep{64, 8, 1}, kLeafStep{9, 3, 1};
  const int along = (lower[kAxis] & 7) + step, first = lower[kFirst] & 7, second = lower[kSecond] & 7;
  // Into the leaf before, the same, or the one after; a step to either side of it is at most one leaf.
  const unsigned leaf = 13 + kLeafStep[kAxis] * unsigned(along >> 3), corner = kStep[kAxis] * unsigned(along & 7);
  bool active = true;
  if (first < 7 && second < 7) {
    Leaves& near = component.near;
    if (!(near.fetched >> leaf & 1u)) fetch(component, leaf);
    if (const Leaf* own = near.leaf[leaf]) {
      const unsigned offset = corner + kStep[kFirst] * unsigned(first) + kStep[kSecond] * unsigned(second);
      const std::array<unsigned, 4> at{offset, offset + kStep[kSecond], offset + kStep[kFirst],
                                       offset + kStep[kFirst] + kStep[kSecond]};
#pragma GCC unroll 4
      for (std::size_t tap = 0; tap < 4; ++tap) {
        values[tap] = near.values[leaf][at[tap]];
        active &= own->valueMask().isOn(at[tap]);
      }
      return active;
    }
  }
#pragma GCC unroll 4
  for (int tap = 0; tap < 4; ++tap) {
    const int f = first + (tap >> 1), s = second + (tap & 1);
    const unsigned which = leaf + kLeafStep[kFirst] * unsigned(f >> 3) + kLeafStep[kSecond] * unsigned(s >> 3);
    const unsigned offset = corner + kStep[kFirst] * unsigned(f & 7) + kStep[kSecond] * unsigned(s & 7);
    active &= value(component, which, offset, values[std::size_t(tap)]);
  }
  return active;
}

// f(t + 1/2) - f(t - 1/2) along each axis: the mean of the slopes of this cell and of the next one, weighted
// by how far the voxel around t reaches into each. Where the next one is not all known, this cell's own.
Vec3d VelocitySampler::slopes(Component& component, const Coord& lower, const std::array<double, 8>& c,
                              const Vec3d& t) {
  Vec3d result;
  const auto along = [&]<int kAxis>() {
    using At = Corners<kAxis>;
    const double first = t[kAxis == 0 ? 1 : 0], second = t[kAxis == 2 ? 1 : 2];
    const double below = bilinear(c[0], c[At::kSecond], c[At::kFirst], c[At::kFirst + At::kSecond], first, second);
    const double above = bilinear(c[At::kAlong], c[At::kAlong + At::kSecond], c[At::kAlong + At::kFirst],
                                  c[At::kAlong + At::kFirst + At::kSecond], first, second);
    result[kAxis] = above - below;
    const bool down = t[kAxis] < 0.5;
    std::array<double, 4> beside;
    if (!valuesBeside<kAxis>(component, lower, down ? -1 : 2, beside)) return;
    const double next = bilinear(beside[0], beside[1], beside[2], beside[3], first, second);
    const double slope = down ? below - next : next - above;
    result[kAxis] += std::abs(t[kAxis] - 0.5) * (slope - result[kAxis]);
  };
  along.template operator()<0>();
  along.template operator()<1>();
  along.template operator()<2>();
  return result;
}

template <bool kGradient>
double VelocitySampler::sampleComponent(Component& component, const Vec3d& x, double& value,
                                        Vec3d& gradient) {
  if (!component.grid) return 0.0;
  const Vec3d index = component.scale * x + component.shift;
  const Vec3d floor(std::floor(index.x()), std::floor(index.y()), std::floor(index.z()));
  const double fx = index.x() - floor.x(), fy = index.y() - floor.y(), fz = index.z() - floor.z();
  std::array<double, 8> c;
  const unsigned active = valuesAround(component, Coord(int(floor.x()), int(floor.y()), int(floor.z())), c);
  if (active == 0) return 0.0;
  double known = 1.0;
  if (active != 0xffu) {
    double mean = 0.0;
    for (unsigned tap = 0; tap < 8; ++tap) mean += active >> tap & 1 ? c[tap] : 0.0;
    mean /= std::popcount(active);
    for (unsigned tap = 0; tap < 8; ++tap) c[tap] = active >> tap & 1 ? c[tap] : mean;
    known = std::popcount(active) / 8.0;
  }
  const double c00 = c[0] + fz * (c[1] - c[0]), c01 = c[2] + fz * (c[3] - c[2]);
  const double c10 = c[4] + fz * (c[5] - c[4]), c11 = c[6] + fz * (c[7] - c[6]);
  const double c0 = c00 + fy * (c01 - c00), c1 = c10 + fy * (c11 - c10);
  value = c0 + fx * (c1 - c0);
  if constexpr (kGradient) {
    gradient = component.scale *
               slopes(component, Coord(int(floor.x()), int(floor.y()), int(floor.z())), c, Vec3d(fx, fy, fz));
  }
  return known;
}

template <bool kGradient>
VelocitySample VelocitySampler::sample(const Vec3d& x) {
  VelocitySample result;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d row(0.0);
    result.known += sampleComponent<kGradient>(m_components[axis], x, result.velocity[axis], row) / 3.0;
    if constexpr (kGradient) result.gradient.setRow(axis, row);
  }
  return result;
}

VelocitySample VelocitySampler::velocity(const Vec3d& x) {
  return sample<false>(x);
}

VelocitySample VelocitySampler::velocityAndGradient(const Vec3d& x) {
  return sample<true>(x);
}

}  // namespace fluidtex::transport
