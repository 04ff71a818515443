#include "caches/liquid/velocity_grids.h"

#include "sim/grid/dilate.h"

#include <openvdb/tools/Interpolation.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <memory>
#include <optional>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Mat4d;
using openvdb::Vec3d;
using openvdb::Vec3f;
using sim::FloatLeaf;

template <class Tree>
std::vector<const typename Tree::LeafNodeType*> leavesOf(const Tree& tree) {
  std::vector<const typename Tree::LeafNodeType*> leaves;
  tree.getNodes(leaves);
  return leaves;
}

const openvdb::GridBase& gridOf(const RawVelocity& raw, int axis) {
  if (raw.vectors) return *raw.vectors;
  return *raw.numbers[std::size_t(axis)];
}

// The index-to-world matrix of a grid's component, in the world's axes. face: the axis along which it is
// shifted by half a voxel, or -1.
Mat4d worldFromIndex(const openvdb::GridBase& grid, const Mat4d& worldFromFile, int face) {
  Mat4d matrix = grid.transform().baseMap()->getAffineMap()->getMat4() * worldFromFile;
  if (face >= 0) {
    Vec3d shift(0.0);
    shift[face] = -0.5;
    Mat4d first = Mat4d::identity();
    first.setTranslation(shift);
    matrix = first * matrix;
  }
  return matrix;
}

// Whether a matrix scales by factors above 0 only, to a billionth.
bool scalesOnly(const Mat3d& matrix) {
  const double largest = std::max({std::abs(matrix[0][0]), std::abs(matrix[1][1]), std::abs(matrix[2][2])});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i == j ? !(matrix[i][i] > 0.0) : std::abs(matrix[i][j]) > 1e-9 * largest) return false;
  return true;
}

openvdb::math::Transform::Ptr alignedTransform(const Mat4d& matrix) {
  const Mat3d linear = matrix.getMat3();
  return std::make_shared<openvdb::math::Transform>(std::make_shared<openvdb::math::ScaleTranslateMap>(
      Vec3d(linear[0][0], linear[1][1], linear[2][2]), matrix.getTranslation()));
}

// The values of a tree, converted by value(v), with the same active voxels. Tiles of 0 are left out.
template <class Tree, class Value>
sim::FloatGrid::Ptr copied(const Tree& tree, const Value& value) {
  const sim::FloatGrid::Ptr grid = sim::FloatGrid::create(0.0f);
  const auto leaves = leavesOf(tree);
  std::vector<std::unique_ptr<FloatLeaf>> made(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    if (leaves[n]->isEmpty()) return;
    made[n] = std::make_unique<FloatLeaf>(leaves[n]->origin(), 0.0f, false);
    for (auto voxel = leaves[n]->cbeginValueOn(); voxel; ++voxel)
      made[n]->setValueOn(voxel.pos(), value(*voxel));
  });
  for (std::unique_ptr<FloatLeaf>& leaf : made)
    if (leaf) grid->tree().addLeaf(leaf.release());
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(Tree::DEPTH - 2);
  for (; tile; ++tile)
    if (const float number = value(*tile); number != 0.0f)
      grid->tree().sparseFill(tile.getBoundingBox(), number, true);
  grid->tree().voxelizeActiveTiles();
  return grid;
}

sim::FaceGrids alignedVelocity(const RawVelocity& raw, const std::array<Mat4d, 3>& matrices) {
  sim::FaceGrids velocity;
  for (int axis = 0; axis < 3; ++axis) {
    const float factor = float(raw.velocityFromFile[axis][axis]);
    velocity.component[axis] =
        raw.vectors ? copied(raw.vectors->tree(), [=](const Vec3f& v) { return factor * v[axis]; })
                    : copied(raw.numbers[axis]->tree(), [=](float v) { return factor * v; });
    velocity.component[axis]->setTransform(alignedTransform(matrices[axis]));
  }
  return velocity;
}

// Linear interpolation of component `axis` of a grid, where all eight values are active.
class Component {
 public:
  Component(const RawVelocity& raw, int axis, const Mat4d& matrix)
      : m_axis(axis), m_indexFromWorld(matrix.inverse()) {
    if (raw.vectors)
      m_vectors.emplace(raw.vectors->tree());
    else
      m_numbers.emplace(raw.numbers[axis]->tree());
  }

  bool at(const Vec3d& x, double& value) {
    const Vec3d index = m_indexFromWorld.transform(x);
    const Coord low = Coord::floor(index);
    const Vec3d t = index - low.asVec3d();
    double sum = 0.0, weights = 0.0;
    for (int n = 0; n < 8; ++n) {
      const Coord corner = low.offsetBy(n >> 2, n >> 1 & 1, n & 1);
      const double weight =
          (n & 4 ? t[0] : 1.0 - t[0]) * (n & 2 ? t[1] : 1.0 - t[1]) * (n & 1 ? t[2] : 1.0 - t[2]);
      float v = 0.0f;
      if (!probe(corner, v)) continue;
      sum += weight * v;
      weights += weight;
    }
    if (weights < 0.5) return false;
    value = sum / weights;
    return true;
  }

 private:
  bool probe(const Coord& corner, float& v) {
    if (m_numbers) return m_numbers->probeValue(corner, v);
    Vec3f vector;
    const bool active = m_vectors->probeValue(corner, vector);
    v = vector[m_axis];
    return active;
  }

  int m_axis;
  Mat4d m_indexFromWorld;
  std::optional<openvdb::Vec3SGrid::ConstAccessor> m_vectors;
  std::optional<openvdb::FloatGrid::ConstAccessor> m_numbers;
};

sim::FaceGrids resampledVelocity(const RawVelocity& raw, const std::array<Mat4d, 3>& matrices, double h,
                                 const sim::MaskTree& near) {
  const auto leaves = leavesOf(near);
  std::array<std::vector<std::unique_ptr<FloatLeaf>>, 3> made;
  for (auto& component : made) component.resize(leaves.size());
  const openvdb::math::Transform::Ptr transform = sim::cellTransform(h);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    std::array<Component, 3> components{Component(raw, 0, matrices[0]), Component(raw, 1, matrices[1]),
                                        Component(raw, 2, matrices[2])};
    for (auto& component : made) component[n] = std::make_unique<FloatLeaf>(leaves[n]->origin(), 0.0f, false);
    for (sim::MaskTree::LeafNodeType::ValueOnCIter voxel = leaves[n]->cbeginValueOn(); voxel; ++voxel) {
      const Vec3d x = transform->indexToWorld(voxel.getCoord());
      Vec3d v;
      if (!components[0].at(x, v[0]) || !components[1].at(x, v[1]) || !components[2].at(x, v[2])) continue;
      v = raw.velocityFromFile.transform(v);
      for (int axis = 0; axis < 3; ++axis) made[axis][n]->setValueOn(voxel.pos(), float(v[axis]));
    }
  });
  sim::FaceGrids velocity;
  for (int axis = 0; axis < 3; ++axis) {
    velocity.component[axis] = sim::FloatGrid::create(0.0f);
    velocity.component[axis]->setTransform(transform);
    for (std::unique_ptr<FloatLeaf>& leaf : made[axis])
      if (!leaf->isEmpty()) velocity.component[axis]->tree().addLeaf(leaf.release());
  }
  return velocity;
}

}  // namespace

openvdb::BBoxd boundsOf(const RawVelocity& raw) {
  openvdb::BBoxd bounds;
  for (int axis = 0; axis < (raw.vectors ? 1 : 3); ++axis) {
    const openvdb::GridBase& grid = gridOf(raw, axis);
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) continue;
    const Mat4d matrix = worldFromIndex(grid, raw.worldFromFile, -1);
    for (int corner = 0; corner < 8; ++corner) {
      const Coord at(corner & 1 ? box.max()[0] : box.min()[0], corner & 2 ? box.max()[1] : box.min()[1],
                     corner & 4 ? box.max()[2] : box.min()[2]);
      bounds.expand(matrix.transform(at.asVec3d()));
    }
  }
  return bounds;
}

sim::FaceGrids velocityGrids(const RawVelocity& raw, const openvdb::FloatGrid& phi, double reach) {
  std::array<Mat4d, 3> matrices;
  bool aligned = scalesOnly(raw.velocityFromFile);
  for (int axis = 0; axis < 3; ++axis) {
    const openvdb::GridBase& grid = gridOf(raw, axis);
    matrices[axis] = worldFromIndex(grid, raw.worldFromFile, raw.vectors && raw.onFaces ? axis : -1);
    aligned = aligned && scalesOnly(matrices[axis].getMat3());
  }
  return aligned ? alignedVelocity(raw, matrices)
                 : resampledVelocity(raw, matrices, phi.voxelSize()[0], *leavesNear(phi, reach));
}

sim::FaceGrids velocityGrids(const std::vector<openvdb::FloatGrid::Ptr>& components) {
  sim::FaceGrids velocity;
  for (int axis = 0; axis < 3; ++axis)
    velocity.component[axis] = sim::fromOpenVdb(*components[std::size_t(axis)]);
  return velocity;
}

sim::MaskTree::Ptr leavesNear(const openvdb::FloatGrid& phi, double reach) {
  openvdb::MaskTree blocks;  // a voxel a leaf
  openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(blocks);
  for (const auto* leaf : leavesOf(phi.tree()))
    if (const Coord& at = leaf->origin(); !leaf->isEmpty())
      accessor.setValueOn(Coord(at[0] >> 3, at[1] >> 3, at[2] >> 3));
  const int layers = int(std::ceil(std::ceil(reach / phi.voxelSize()[0]) / sim::kLeafDim));
  openvdb::tools::dilateActiveValues(blocks, layers, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::EXPAND_TILES);
  blocks.voxelizeActiveTiles();
  const auto near = std::make_shared<sim::MaskTree>();
  for (auto block = blocks.cbeginValueOn(); block; ++block) {
    const Coord at = block.getCoord();
    near->touchLeaf(Coord(at[0] << 3, at[1] << 3, at[2] << 3))->setValuesOn();
  }
  return near;
}

sim::FaceGrids blended(const sim::FaceGrids& a, const sim::FaceGrids& b, double t) {
  if (t <= 0.0) return a;
  if (t >= 1.0) return b;
  sim::FaceGrids result;
  for (int axis = 0; axis < 3; ++axis) {
    const sim::FloatTree &first = a[axis].constTree(), &second = b[axis].constTree();
    const sim::FloatGrid::Ptr grid = sim::FloatGrid::create(0.0f);
    grid->setTransform(a[axis].transform().copy());
    grid->tree().topologyUnion(first);
    grid->tree().topologyUnion(second);
    const auto leaves = sim::leavesOf(grid->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      const FloatLeaf* of[2] = {first.probeConstLeaf(leaves[n]->origin()),
                                second.probeConstLeaf(leaves[n]->origin())};
      for (auto voxel = leaves[n]->beginValueOn(); voxel; ++voxel) {
        const openvdb::Index i = voxel.pos();
        const bool inFirst = of[0] && of[0]->isValueOn(i), inSecond = of[1] && of[1]->isValueOn(i);
        const float va = inFirst ? of[0]->getValue(i) : 0.0f, vb = inSecond ? of[1]->getValue(i) : 0.0f;
        voxel.setValue(inFirst && inSecond ? va + float(t) * (vb - va) : inFirst ? va : vb);
      }
    });
    result.component[axis] = grid;
  }
  return result;
}

bool isUnknown(const sim::FaceGrids& velocity) {
  for (int axis = 0; velocity && axis < 3; ++axis)
    if (!velocity[axis].empty() && velocity[axis].constTree().activeVoxelCount() > 0) return false;
  return true;
}

bool sameTransforms(const sim::FaceGrids& a, const sim::FaceGrids& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis].transform() != b[axis].transform()) return false;
  return true;
}

}  // namespace fluidtex::caches
