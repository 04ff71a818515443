// The staggered grid: Harlow and Welch, "Numerical calculation of time-dependent viscous incompressible flow
// of fluid with free surface", 1965. Storage: Museth, "VDB: high-resolution sparse volumes with dynamic
// topology", 2013.
#include "sim/mac_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace fluidtex::sim {

openvdb::math::Transform::Ptr cellTransform(double h) {
  auto transform = openvdb::math::Transform::createLinearTransform(h);
  transform->postTranslate(Vec3d(0.5 * h));
  return transform;
}

openvdb::math::Transform::Ptr faceTransform(double h, int axis) {
  Vec3d shift(0.5 * h);
  shift[axis] = 0.0;
  auto transform = openvdb::math::Transform::createLinearTransform(h);
  transform->postTranslate(shift);
  return transform;
}

Coord cellCount(const Vec3d& size, double h) {
  // A side that is a whole number of cells but for rounding gets no further cell.
  constexpr double kSlack = 1e-6;
  Coord n;
  for (int a = 0; a < 3; ++a) n[a] = std::max(1, static_cast<int>(std::ceil(size[a] / h - kSlack)));
  return n;
}

FloatGrid::Ptr makePhi(double h, double background) {
  auto phi = FloatGrid::create(static_cast<float>(background));
  phi->setTransform(cellTransform(h));
  phi->setGridClass(openvdb::GRID_LEVEL_SET);
  phi->setName("phi");
  return phi;
}

Velocity makeVelocity(double h) {
  static constexpr const char* kNames[3] = {"u", "v", "w"};
  Velocity velocity;
  for (int a = 0; a < 3; ++a) {
    velocity.component[a] = FloatGrid::create(0.0f);
    velocity.component[a]->setTransform(faceTransform(h, a));
    velocity.component[a]->setName(kNames[a]);
  }
  return velocity;
}

Velocity makeVelocity(double h, const FloatTree& like) {
  Velocity velocity = makeVelocity(h);
  for (auto& grid : velocity.component) {
    grid->setTree(std::make_shared<FloatTree>(like, 0.0f, openvdb::TopologyCopy()));
  }
  return velocity;
}

Velocity copyOf(const Velocity& velocity) {
  Velocity copy;
  for (int a = 0; a < 3; ++a) copy.component[a] = velocity.component[a]->deepCopy();
  return copy;
}

std::vector<FloatLeaf*> leavesOf(FloatTree& tree) {
  std::vector<FloatLeaf*> leaves;
  leaves.reserve(tree.leafCount());
  tree.getNodes(leaves);
  return leaves;
}

std::vector<const FloatLeaf*> leavesOf(const FloatTree& tree) {
  std::vector<const FloatLeaf*> leaves;
  leaves.reserve(tree.leafCount());
  tree.getNodes(leaves);
  return leaves;
}

void gather(const FloatTree& tree, const Coord& origin, int halo, float* out, bool crossOnly) {
  const openvdb::tree::ValueAccessor<const FloatTree> accessor(tree);
  const int side = kLeafDim + 2 * halo;
  const int reach = halo > 0 ? 1 : 0;
  for (int di = -reach; di <= reach; ++di) {
    for (int dj = -reach; dj <= reach; ++dj) {
      for (int dk = -reach; dk <= reach; ++dk) {
        if (crossOnly && std::abs(di) + std::abs(dj) + std::abs(dk) > 1) continue;
        const Coord corner = origin.offsetBy(kLeafDim * di, kLeafDim * dj, kLeafDim * dk);
        const FloatLeaf* leaf = accessor.probeConstLeaf(corner);
        const float* data = leaf != nullptr ? leaf->buffer().data() : nullptr;
        const float fill = leaf != nullptr ? 0.0f : accessor.getValue(corner);
        // The part of this leaf inside the box, in the leaf's own indices.
        const auto first = [&](int d) { return d < 0 ? kLeafDim - halo : 0; };
        const auto last = [&](int d) { return d > 0 ? halo : kLeafDim; };
        const int k0 = first(dk), count = last(dk) - k0;
        for (int i = first(di); i < last(di); ++i) {
          for (int j = first(dj); j < last(dj); ++j) {
            float* to = out + ((i + kLeafDim * di + halo) * side + j + kLeafDim * dj + halo) * side + k0 +
                        kLeafDim * dk + halo;
            if (data != nullptr) {
              std::memcpy(to, data + 64 * i + 8 * j + k0, sizeof(float) * count);
            } else {
              std::fill_n(to, count, fill);
            }
          }
        }
      }
    }
  }
}

double maxAbs(const Velocity& velocity) {
  double largest = 0.0;
  for (const auto& grid : velocity.component) {
    const auto leaves = leavesOf(grid->constTree());
    largest = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, leaves.size(), 16), largest,
        [&](const tbb::blocked_range<std::size_t>& range, double most) {
          for (std::size_t n = range.begin(); n != range.end(); ++n) {
            for (auto it = leaves[n]->cbeginValueOn(); it; ++it) {
              const double value = std::abs(static_cast<double>(*it));
              most = std::isfinite(value) ? std::max(most, value) : std::numeric_limits<double>::infinity();
            }
          }
          return most;
        },
        [](double a, double b) { return std::max(a, b); });
  }
  return largest;
}

}  // namespace fluidtex::sim
