#include "transport/velocity_sampler.h"

#include "numerics/lanes.h"
#include "transport/within_reach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fluidtex::transport {
namespace {

using Leaf = sim::FloatTree::LeafNodeType;

constexpr int kSide = int(Leaf::DIM);
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

// Bilinear between four values, [2 dFirst + dSecond].
[[gnu::always_inline]] inline double bilinear(const std::array<double, 4>& v, double first, double second) {
  const double v0 = v[0] + second * (v[1] - v[0]), v1 = v[2] + second * (v[3] - v[2]);
  return v0 + first * (v1 - v0);
}

[[gnu::always_inline]] inline double trilinear(const std::array<double, 8>& c, const Vec3d& t) {
  const double below = bilinear({c[0], c[1], c[2], c[3]}, t.y(), t.z());
  return below + t.x() * (bilinear({c[4], c[5], c[6], c[7]}, t.y(), t.z()) - below);
}

// Replaces unknown values by the mean of the known ones; returns the share of known values.
double fillUnknown(std::array<double, 8>& c) {
  double sum = 0.0;
  int known = 0;
  for (const double value : c) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++known;
  }
  if (known == 0) return 0.0;
  for (double& value : c) value = std::isfinite(value) ? value : sum / known;
  return known / 8.0;
}

// f(t + 1/2) - f(t - 1/2) along an axis: slopes of this cell and the next one, weighted by how far the voxel
// around t reaches into each. This cell's own where the next one is not all known. at(i, j, k): value so many
// voxels from the cell's lowest corner; c: the corners' values [4 i + 2 j + k].
template <int kAxis, typename At>
double slope(const At& at, const std::array<double, 8>& c, const Vec3d& t) {
  constexpr unsigned kAlong = 4u >> kAxis, kFirst = kAxis == 0 ? 2 : 4, kSecond = kAxis == 2 ? 2 : 1;
  const double first = t[kAxis == 0 ? 1 : 0], second = t[kAxis == 2 ? 1 : 2];
  const double below = bilinear({c[0], c[kSecond], c[kFirst], c[kFirst + kSecond]}, first, second);
  const double above = bilinear(
      {c[kAlong], c[kAlong + kSecond], c[kAlong + kFirst], c[kAlong + kFirst + kSecond]}, first, second);
  const double own = above - below;
  const bool down = t[kAxis] < 0.5;
  const int step = down ? -1 : 2;
  const auto beside = [&](int i, int j) {
    if constexpr (kAxis == 0) return at(step, i, j);
    if constexpr (kAxis == 1) return at(i, step, j);
    if constexpr (kAxis == 2) return at(i, j, step);
  };
  const double next = bilinear({beside(0, 0), beside(0, 1), beside(1, 0), beside(1, 1)}, first, second);
  const double change = std::abs(t[kAxis] - 0.5) * ((down ? below - next : next - above) - own);
  return std::isfinite(change) ? own + change : own;
}

// Value and slopes at t within a cell; returns the share of its corners that are known.
template <bool kGradient, typename At>
double interpolate(const At& at, const Vec3d& t, double& value, Vec3d& slopes) {
  std::array<double, 8> c{at(0, 0, 0), at(0, 0, 1), at(0, 1, 0), at(0, 1, 1),
                          at(1, 0, 0), at(1, 0, 1), at(1, 1, 0), at(1, 1, 1)};
  double known = 1.0;
  value = trilinear(c, t);
  if (!std::isfinite(value)) {
    known = fillUnknown(c);
    value = known > 0.0 ? trilinear(c, t) : 0.0;
    if (known == 0.0) return 0.0;
  }
  if constexpr (kGradient) slopes = Vec3d(slope<0>(at, c, t), slope<1>(at, c, t), slope<2>(at, c, t));
  return known;
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
    component.accessor.emplace(component.grid->tree());
  }
  m_voxelSize = std::isfinite(smallest) ? smallest : 0.0;
  if (substep.u && substep.v && substep.w) m_visibility = substep.visibility;
}

void VelocitySampler::focus(const Vec3d& lower, const Vec3d& upper) {
  for (Component& component : m_components) {
    if (!component.grid) continue;
    const Vec3d a = component.scale * lower + component.shift, b = component.scale * upper + component.shift;
    if (!withinReach(a) || !withinReach(b)) {
      component.window.size = Coord(0);
      continue;
    }
    // One voxel more below and two above, as a cell and its slopes read. Along z by whole leaves, so that
    // each row of a leaf is one copy.
    Coord first = Coord::floor(openvdb::math::minComponent(a, b)).offsetBy(-1);
    Coord end = Coord::floor(openvdb::math::maxComponent(a, b)).offsetBy(3);
    first.z() &= ~(kSide - 1);
    end.z() = (end.z() + kSide - 1) & ~(kSide - 1);
    component.window.origin = first;
    component.window.size = end - first;
    fill(component);
  }
}

void VelocitySampler::fill(Component& component) {
  Window& window = component.window;
  const Coord first = window.origin, size = window.size, end = first + size;
  window.values.resize(std::size_t(size.x()) * std::size_t(size.y()) * std::size_t(size.z()));
  float* const to = window.values.data();
  const std::ptrdiff_t alongY = size.z(), alongX = alongY * size.y();
  // For unknown values.
  const Float8 unknown = Float8{} + kUnknown;
  for (int x0 = first.x() & ~(kSide - 1); x0 < end.x(); x0 += kSide) {
    const int xFirst = std::max(x0, first.x()), xEnd = std::min(x0 + kSide, end.x());
    for (int y0 = first.y() & ~(kSide - 1); y0 < end.y(); y0 += kSide) {
      const int yFirst = std::max(y0, first.y()), yEnd = std::min(y0 + kSide, end.y());
      for (int z0 = first.z(); z0 < end.z(); z0 += kSide) {
        const Leaf* leaf = component.accessor->probeConstLeaf(Coord(x0, y0, z0));
        const float* from = leaf ? leaf->buffer().data() : nullptr;
        float tile = 0.0f;
        if (!leaf && !component.accessor->probeValue(Coord(x0, y0, z0), tile)) tile = kUnknown;
        for (int x = xFirst; x < xEnd; ++x) {
          float* row = to + (x - first.x()) * alongX + (yFirst - first.y()) * alongY + (z0 - first.z());
          const std::uint64_t active =
              leaf ? leaf->valueMask().getWord<std::uint64_t>(std::uint32_t(x - x0)) : 0;
          for (int y = yFirst; y < yEnd; ++y, row += alongY) {
            const int local = y - y0;
            store8(row, leaf ? select8(unsigned(active >> (kSide * local)) & 0xffu,
                                       load8(from + kSide * (kSide * (x - x0) + local)), unknown)
                             : Float8{} + tile);
          }
        }
      }
    }
  }
}

template <bool kGradient>
double VelocitySampler::sampleComponent(Component& component, const Vec3d& x, double& value,
                                        Vec3d& gradient) {
  if (!component.grid) return 0.0;
  const Vec3d index = component.scale * x + component.shift;
  if (!withinReach(index)) return 0.0;
  const Vec3d floor(std::floor(index.x()), std::floor(index.y()), std::floor(index.z()));
  const Coord lower(int(floor.x()), int(floor.y()), int(floor.z()));
  const Vec3d t = index - floor;
  const Window& window = component.window;
  const Coord local = lower - window.origin;
  const auto within = [&](int axis) {
    return unsigned(local[axis] - 1) < unsigned(std::max(window.size[axis] - 3, 0));
  };
  double known = 0.0;
  if (within(0) && within(1) && within(2)) {
    const std::ptrdiff_t alongY = window.size.z(), alongX = alongY * window.size.y();
    const float* corner = window.values.data() + local.x() * alongX + local.y() * alongY + local.z();
    const auto at = [=](int i, int j, int k) { return double(corner[i * alongX + j * alongY + k]); };
    known = interpolate<kGradient>(at, t, value, gradient);
  } else {
    const auto at = [&](int i, int j, int k) {
      float result = 0.0f;
      return double(component.accessor->probeValue(lower.offsetBy(i, j, k), result) ? result : kUnknown);
    };
    known = interpolate<kGradient>(at, t, value, gradient);
  }
  if constexpr (kGradient) gradient *= component.scale;
  return known;
}

template <bool kGradient>
VelocitySample VelocitySampler::sample(const Vec3d& x) {
  VelocitySample result;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d row(0.0);
    result.known += sampleComponent<kGradient>(m_components[axis], x, result.velocity[axis], row);
    if constexpr (kGradient) result.gradient.setRow(axis, row);
  }
  result.known *= 1.0 / 3.0;
  return result;
}

// For the inline functions of the header.
template VelocitySample VelocitySampler::sample<false>(const Vec3d& x);
template VelocitySample VelocitySampler::sample<true>(const Vec3d& x);

Vec3d VelocitySampler::inCells(const Vec3d& x) const {
  // Along its own axis a component's voxels are the cells' lower faces.
  Vec3d place;
  for (int axis = 0; axis < 3; ++axis)
    place[axis] = m_components[axis].scale[axis] * x[axis] + m_components[axis].shift[axis];
  return place;
}

const sim::VisibleCells* VelocitySampler::around(const Coord& cell) {
  const Coord block(cell.x() & ~(kSide - 1), cell.y() & ~(kSide - 1), cell.z() & ~(kSide - 1));
  if (block != m_block) {
    m_block = block;
    m_leaf = m_visibility->leaf(block);
  }
  if (m_leaf == nullptr) return nullptr;
  const Coord local = cell - block;
  const sim::VisibleCells& visible =
      (*m_leaf)[std::size_t((local.x() * kSide + local.y()) * kSide + local.z())];
  return visible.seesAll() ? nullptr : &visible;
}

WallSide VelocitySampler::nearestOutside(const Vec3d& x) {
  const Vec3d place = inCells(x);
  if (!withinReach(place)) return {};
  const Coord cell = Coord::floor(place);
  // A cell from which all is seen counts as outside: whatever is read from it is right.
  const auto isInSolid = [&](const Coord& at) {
    const sim::VisibleCells* visible = around(at);
    return visible != nullptr && visible->isInSolid();
  };
  if (!isInSolid(cell)) return {cell, around(cell) != nullptr};
  // Of the cells between whose centres the place lies.
  const Vec3d away = place - cell.asVec3d() - Vec3d(0.5);
  Coord nearest = cell;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 1; n < 8; ++n) {
    Coord beside = cell;
    for (int axis = 0; axis < 3; ++axis)
      if ((n >> axis & 1) != 0) beside[axis] += away[axis] < 0.0 ? -1 : 1;
    const double distance = (place - beside.asVec3d() - Vec3d(0.5)).lengthSqr();
    if (distance >= least || isInSolid(beside)) continue;
    nearest = beside;
    least = distance;
  }
  return {nearest, around(nearest) != nullptr};
}

VelocitySample VelocitySampler::besideWall(const Vec3d& x, const WallSide& side) {
  Coord cell = nearestOutside(x).cell;
  if (m_visibility->hides(side.cell, cell)) cell = side.cell;
  const sim::VisibleCells* visible = around(cell);
  if (visible == nullptr) return sample<false>(x);
  const Vec3f place(inCells(x) - cell.asVec3d() - Vec3d(0.5));
  Vec3f inside;
  for (int axis = 0; axis < 3; ++axis) inside[axis] = std::clamp(place[axis], -0.5f, 0.5f);
  VelocitySample result;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d change(sim::moveToOwnSide(*visible, inside, axis) - place);
    Vec3d none;
    result.known += sampleComponent<false>(m_components[axis], x + change / m_components[axis].scale,
                                           result.velocity[axis], none);
  }
  result.known *= 1.0 / 3.0;
  return result;
}

VelocitySample VelocitySampler::besideWallAndGradient(const Vec3d& x, const WallSide& side) {
  VelocitySample result = besideWall(x, side);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3d half(0.0);
    half[axis] = 0.5 * m_voxelSize;
    const Vec3d difference = besideWall(x + half, side).velocity - besideWall(x - half, side).velocity;
    result.gradient.setCol(axis, difference / m_voxelSize);
  }
  return result;
}

}  // namespace fluidtex::transport
