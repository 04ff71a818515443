#include "sim/grid/grids.h"

#include <openvdb/tools/Prune.h>

#include <memory>
#include <type_traits>

namespace fluidtex::sim {
namespace {

template <typename To, typename From>
typename To::Ptr converted(const From& from) {
  using Leaf = typename To::TreeType::LeafNodeType;
  static_assert(std::is_same_v<Leaf, typename From::TreeType::LeafNodeType>);
  auto to = To::create(from.background());
  auto tile = from.constTree().cbeginValueAll();
  tile.setMaxDepth(From::TreeType::DEPTH - 2);
  for (; tile; ++tile) {
    if (tile.isValueOn() || *tile != from.background())
      to->tree().sparseFill(tile.getBoundingBox(), *tile, tile.isValueOn());
  }
  for (auto leaf = from.constTree().cbeginLeaf(); leaf; ++leaf) to->tree().addLeaf(new Leaf(*leaf));
  openvdb::tools::pruneTiles(to->tree());
  to->insertMeta(from);
  to->setTransform(from.transform().copy());
  return to;
}

}  // namespace

openvdb::FloatGrid::Ptr toOpenVdb(const FloatGrid& grid) {
  return converted<openvdb::FloatGrid>(grid);
}

FloatGrid::Ptr fromOpenVdb(const openvdb::FloatGrid& grid) {
  return converted<FloatGrid>(grid);
}

}  // namespace fluidtex::sim

FLUIDTEX_GRID(, fluidtex::sim::FloatTree)
