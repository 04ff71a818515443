#include "caches/liquid/fitted_velocity.h"

#include "caches/liquid/continue_outwards.h"
#include "caches/liquid/velocity_grids.h"

#include <openvdb/math/Mat3.h>
#include <openvdb/tools/Filter.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using openvdb::Mat3d;
using openvdb::Vec3d;
using Leaf = openvdb::FloatTree::LeafNodeType;

// Of the mean over a cube, applied twice: cells to either side.
constexpr int kWidth = 1, kTimes = 2;
// What is added to the equations' diagonal, as a share of their trace: motion along the surface is taken from
// what bends by more than the level sets are inexact by.
constexpr double kLeastSlope = 0.01;
// Cells around the surface from which motion is taken: farther away both level sets may be cut off.
constexpr double kNear = 3.0;

// Products of d = (grad phi, dphi/dt): xx, xy, xz, yy, yz, zz, xt, yt, zt.
constexpr std::array<std::array<int, 2>, 9> kProducts{
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}, {0, 3}, {1, 3}, {2, 3}}};
using Products = std::array<FloatGrid::Ptr, 9>;

Products productsOf(const FloatGrid& last, const FloatGrid& phi, double seconds) {
  const double h = phi.voxelSize()[0];
  Products products;
  for (FloatGrid::Ptr& product : products) {
    product = FloatGrid::create(0.0f);
    product->setTransform(phi.transform().copy());
    product->tree().topologyUnion(phi.tree());
    product->tree().topologyUnion(last.tree());
    product->tree().voxelizeActiveTiles();
  }
  std::array<std::vector<Leaf*>, 9> leaves;
  for (std::size_t p = 0; p < 9; ++p) products[p]->tree().getNodes(leaves[p]);
  tbb::parallel_for(std::size_t{0}, leaves[0].size(), [&](std::size_t n) {
    const FloatGrid::ConstAccessor before = last.getConstAccessor(), after = phi.getConstAccessor();
    const auto middle = [&](const Coord& c) {
      return 0.5 * (double(before.getValue(c)) + double(after.getValue(c)));
    };
    for (auto value = leaves[0][n]->cbeginValueOn(); value; ++value) {
      const Coord c = value.getCoord();
      std::array<double, 4> d{};
      d[3] = (double(after.getValue(c)) - double(before.getValue(c))) / seconds;
      const bool near = std::abs(middle(c)) < kNear * h;
      for (int axis = 0; near && axis < 3; ++axis) {
        Coord low = c, high = c;
        --low[axis];
        ++high[axis];
        d[std::size_t(axis)] = (middle(high) - middle(low)) / (2.0 * h);
      }
      for (std::size_t p = 0; p < 9; ++p)
        leaves[p][n]->setValueOnly(value.pos(),
                                   float(d[std::size_t(kProducts[p][0])] * d[std::size_t(kProducts[p][1])]));
    }
  });
  for (FloatGrid::Ptr& product : products) openvdb::tools::Filter<FloatGrid>(*product).mean(kWidth, kTimes);
  return products;
}

// A u = -b, of which (A + kLeastSlope tr(A) I)^-1 is the preconditioner of two steps: what A tells well is
// kept to a square of that share, and what it does not tell stays small. False where nothing is known.
bool solve(const std::array<double, 9>& p, Vec3d& u) {
  const double trace = p[0] + p[3] + p[5];
  if (trace < 1e-6) return false;
  const Mat3d a(p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5]);
  const Mat3d inverse = (a + Mat3d::identity() * (kLeastSlope * trace)).inverse();
  const Vec3d b(p[6], p[7], p[8]);
  u = -(inverse * b);
  u -= inverse * (b + a * u);
  return true;
}

}  // namespace

sim::FaceGrids fittedVelocity(const FloatGrid& last, const FloatGrid& phi, double seconds) {
  const Products products = productsOf(last, phi, seconds);
  std::array<std::vector<Leaf*>, 9> leaves;
  for (std::size_t p = 0; p < 9; ++p) products[p]->tree().getNodes(leaves[p]);
  // The first three grids become the velocity.
  tbb::parallel_for(std::size_t{0}, leaves[0].size(), [&](std::size_t n) {
    for (openvdb::Index pos = 0; pos < Leaf::SIZE; ++pos) {
      if (!leaves[0][n]->isValueOn(pos)) continue;
      std::array<double, 9> values{};
      for (std::size_t p = 0; p < 9; ++p) values[p] = double(leaves[p][n]->getValue(pos));
      Vec3d u(0.0);
      const bool known = solve(values, u);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (known)
          leaves[axis][n]->setValueOnly(pos, float(u[int(axis)]));
        else
          leaves[axis][n]->setValueOff(pos);
      }
    }
  });
  std::vector<FloatGrid::Ptr> components(products.begin(), products.begin() + 3);
  for (const FloatGrid::Ptr& component : components) continueOutwards(*component, kContinuedLayers);
  return velocityGrids(components);
}

}  // namespace fluidtex::caches
