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

// Of the trilinear interpolant f between eight values, at t in the cell: d f / d t[axis].
template <int kAxis>
double slopeWithin(const std::array<double, 8>& c, const Vec3d& t) {
  constexpr unsigned kStep = 4u >> kAxis, kFirst = kAxis == 0 ? 2 : 4, kSecond = kAxis == 2 ? 2 : 1;
  const double a = t[kAxis == 0 ? 1 : 0], b = t[kAxis == 2 ? 1 : 2];
  const double s00 = c[kStep] - c[0], s01 = c[kStep + kSecond] - c[kSecond];
  const double s10 = c[kStep + kFirst] - c[kFirst], s11 = c[kStep + kFirst + kSecond] - c[kFirst + kSecond];
  const double s0 = s00 + b * (s01 - s00), s1 = s10 + b * (s11 - s10);
  return s0 + a * (s1 - s0);
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
  const Coord corner = near.origin + Coord(which & 4 ? 8 : 0, which & 2 ? 8 : 0, which & 1 ? 8 : 0);
  near.leaf[which] = component.accessor->probeConstLeaf(corner);
  near.values[which] = near.leaf[which] ? near.leaf[which]->buffer().data() : nullptr;
  near.fetched |= 1u << which;
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
    if (!(near.fetched & 1u)) fetch(component, 0);
    if (const Leaf* leaf = near.leaf[0]) {
      const std::uint64_t square = kSquare << (8 * j + k);
      const bool active = (leaf->valueMask().getWord<std::uint64_t>(i) & square) == square &&
                          (leaf->valueMask().getWord<std::uint64_t>(i + 1) & square) == square;
      if (active) {
        const float* corner = near.values[0] + (64 * i + 8 * j + k);
        values = {corner[0], corner[1], corner[8], corner[9], corner[64], corner[65], corner[72], corner[73]};
        return 0xffu;
      }
    }
  }
  // Along each axis the upper values lie in the next leaf if the lower ones are the last of theirs.
  const unsigned crossX = (i + 1) >> 3, crossY = (j + 1) >> 3, crossZ = (k + 1) >> 3;
  const std::array<unsigned, 2> x{64 * i, 64 * ((i + 1) & 7)}, y{8 * j, 8 * ((j + 1) & 7)}, z{k, (k + 1) & 7};
  unsigned active = 0;
#pragma GCC unroll 8
  for (unsigned tap = 0; tap < 8; ++tap) {
    const unsigned dx = tap >> 2, dy = (tap >> 1) & 1, dz = tap & 1;
    const unsigned which = (dx & crossX) << 2 | (dy & crossY) << 1 | (dz & crossZ);
    if (!(near.fetched & (1u << which))) fetch(component, which);
    const unsigned offset = x[dx] + y[dy] + z[dz];
    if (const Leaf* leaf = near.leaf[which]) {
      values[tap] = near.values[which][offset];
      active |= unsigned(leaf->valueMask().isOn(offset)) << tap;
    } else {
      float tile = 0.0f;
      active |= unsigned(component.accessor->probeValue(lower.offsetBy(int(dx), int(dy), int(dz)), tile))
                << tap;
      values[tap] = tile;
    }
  }
  return active;
}

// f(t + 1/2) - f(t - 1/2) along each axis: the mean of the slopes of this cell and of the next one, weighted
// by how far the voxel around t reaches into each. Where the next one is not all known, this cell's own.
Vec3d VelocitySampler::slopes(Component& component, const Coord& lower, const std::array<double, 8>& values,
                              const Vec3d& t) {
  Vec3d result(slopeWithin<0>(values, t), slopeWithin<1>(values, t), slopeWithin<2>(values, t));
  std::array<double, 8> next;
  const auto blend = [&]<int kAxis>() {
    const double weight = std::abs(t[kAxis] - 0.5);
    Coord beside = lower;
    beside[kAxis] += t[kAxis] < 0.5 ? -1 : 1;
    if (valuesAround(component, beside, next) != 0xffu) return;
    result[kAxis] += weight * (slopeWithin<kAxis>(next, t) - result[kAxis]);
  };
  blend.template operator()<0>();
  blend.template operator()<1>();
  blend.template operator()<2>();
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
