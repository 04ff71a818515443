#include "caches/liquid/level_set.h"

#include "caches/liquid/enclosed_cells.h"
#include "sim/grid/mac_grid.h"

#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Vec3I;
using Leaf = openvdb::FloatTree::LeafNodeType;

// Half the thickness of a surface that encloses nothing, cells.
constexpr double kSheet = 0.75;
// What is enclosed is deeper than this somewhere, cells.
constexpr float kDeep = 0.1f;

bool enclosesNothing(const ClosestTriangles& closest, const EnclosedCells& enclosed) {
  if (!enclosed.boxes.empty()) return false;
  for (std::size_t n = 0; n < enclosed.cells.size(); ++n) {
    bool isDeep = false;
    sim::forBits(enclosed.cells[n], n, [&](std::int64_t cell) {
      isDeep = isDeep || !sim::isSet(closest.known(), cell) || closest.at(cell).square > kDeep * kDeep;
    });
    if (isDeep) return false;
  }
  return true;
}

// A leaf of the cells that are nearer than the band is wide; none where there is none of them. thickness:
// what distances are less, cells.
std::unique_ptr<Leaf> leafOf(const ClosestTriangles& closest, const sim::LeafBits& inside, std::size_t block,
                             double thickness) {
  const auto h = float(closest.cellSize()), band = float(kBand);
  auto leaf = std::make_unique<Leaf>(closest.blocks().origins[block], band * h, false);
  float* values = leaf->buffer().data();
  sim::forBits(inside, 0, [&](std::int64_t cell) { values[cell] = -band * h; });
  sim::forBits(closest.known()[block], block, [&](std::int64_t cell) {
    const float distance = std::sqrt(closest.at(cell).square) - float(thickness);
    if (distance >= band) return;
    float& value = values[cell & 511];
    value = value < 0.0f ? -distance * h : distance * h;
    leaf->setValueOn(openvdb::Index(cell & 511));
  });
  if (leaf->isEmpty()) leaf.reset();
  return leaf;
}

}  // namespace

LevelSet levelSetOf(ClosestTriangles& closest) {
  const double h = closest.cellSize();
  closest.extend(kBand);
  EnclosedCells enclosed = enclosedCells(closest.blocks(), closest.crossed());
  LevelSet result;
  result.isSheet = closest.blocks().size() > 0 && enclosesNothing(closest, enclosed);
  if (result.isSheet) {
    closest.extend(kBand + kSheet);
    enclosed = {sim::VoxelMask(closest.blocks().size()), {}};
  }
  result.phi = openvdb::createLevelSet<openvdb::FloatGrid>(h, kBand);
  result.phi->setTransform(sim::cellTransform(h));
  openvdb::FloatTree& tree = result.phi->tree();
  for (const openvdb::CoordBBox& box : enclosed.boxes) tree.sparseFill(box, -float(kBand * h), false);
  std::vector<std::unique_ptr<Leaf>> leaves(closest.blocks().size());
  sim::forLeaves(closest.blocks(), [&](std::size_t n) {
    leaves[n] = leafOf(closest, enclosed.cells[n], n, result.isSheet ? kSheet : 0.0);
  });
  for (std::unique_ptr<Leaf>& leaf : leaves)
    if (leaf) tree.addLeaf(leaf.release());
  openvdb::tools::pruneTiles(tree);
  return result;
}

LevelSet levelSetOf(const SurfaceTriangles& surface, double h) {
  ClosestTriangles closest(surface, h);
  return levelSetOf(closest);
}

std::vector<openvdb::FloatGrid::Ptr> continuedOff(ClosestTriangles& closest, const ValuesAt& valuesAt,
                                                  int components, int band) {
  closest.extend(band);
  std::vector<openvdb::FloatGrid::Ptr> result;
  std::vector<std::vector<std::unique_ptr<Leaf>>> made(static_cast<std::size_t>(components));
  for (auto& leaves : made) leaves.resize(closest.blocks().size());
  const auto most = float(band) * float(band);
  sim::forLeaves(closest.blocks(), [&](std::size_t n) {
    for (auto& leaves : made) leaves[n] = std::make_unique<Leaf>(closest.blocks().origins[n], 0.0f, false);
    std::vector<double> values(made.size());
    sim::forBits(closest.known()[n], n, [&](std::int64_t cell) {
      const Nearest nearest = closest.at(cell);
      if (nearest.square >= most) return;
      valuesAt(closest.surface().triangles[nearest.triangle], closest.closestPointOf(cell), values.data());
      for (std::size_t c = 0; c < made.size(); ++c)
        if (std::isfinite(values[c])) made[c][n]->setValueOn(openvdb::Index(cell & 511), float(values[c]));
    });
  });
  for (auto& leaves : made) {
    result.push_back(openvdb::FloatGrid::create(0.0f));
    result.back()->setTransform(sim::cellTransform(closest.cellSize()));
    for (std::unique_ptr<Leaf>& leaf : leaves)
      if (!leaf->isEmpty()) result.back()->tree().addLeaf(leaf.release());
  }
  return result;
}

std::vector<openvdb::FloatGrid::Ptr> continuedOff(ClosestTriangles& closest, const std::vector<float>& values,
                                                  int components, int band) {
  const auto count = std::size_t(components);
  const auto valuesAt = [&](const Vec3I& corners, const TrianglePoint& point, double* result) {
    for (std::size_t c = 0; c < count; ++c) {
      result[c] = 0.0;
      for (int corner = 0; corner < 3; ++corner)
        result[c] += point.weight[corner] * double(values[std::size_t(corners[corner]) * count + c]);
    }
  };
  return continuedOff(closest, ValuesAt(valuesAt), components, band);
}

}  // namespace fluidtex::caches
