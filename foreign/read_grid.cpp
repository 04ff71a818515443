#include "foreign/read_grid.h"

#include "foreign/finite.h"
#include "foreign/grid_file.h"
#include "foreign/limits.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <ios>
#include <type_traits>

namespace fluidtex::foreign::here {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3SGrid;

std::string quoted(const std::string& name) {
  return '"' + name + '"';
}

// What the library throws, as a clause behind the file's name.
template <class Work>
auto inWords(const Work& work) {
  try {
    return work();
  } catch (const openvdb::Exception& error) {
    throw Unreadable("is no OpenVDB file that can be read (" + asClause(error.what()) + ")");
  } catch (const std::ios_base::failure&) {
    throw Unreadable("is no OpenVDB file that can be read: it is damaged or cut short");
  }
}

void write(const openvdb::GridBase::Ptr& grid, std::ostream& out) {
  openvdb::io::Stream stream(out);
  stream.setCompression(openvdb::io::COMPRESS_NONE);  // which would drop inactive values
  stream.setGridStatsMetadataEnabled(false);
  stream.write(openvdb::GridCPtrVec{grid});
}

// The library converts no vectors.
template <class To, class From>
typename To::Ptr withValuesOf(const From& from) {
  using Value = typename To::ValueType;
  const Value background(from.background());
  const auto tree = std::make_shared<typename To::TreeType>(from.tree(), background, openvdb::TopologyCopy());
  for (auto leaf = from.tree().cbeginLeaf(); leaf; ++leaf) {
    Value* values = tree->probeLeaf(leaf->origin())->buffer().data();
    for (openvdb::Index i = 0; i < leaf->SIZE; ++i) values[i] = Value(leaf->getValue(i));
  }
  auto tile = from.tree().cbeginValueAll();
  tile.setMaxDepth(tile.LEAF_DEPTH - 1);
  for (; tile; ++tile)
    if (const Value value(*tile); value != background || tile.isValueOn())
      tree->addTile(tile.getLevel(), tile.getCoord(), value, tile.isValueOn());
  auto result = To::create(tree);
  result->insertMeta(from);
  result->setTransform(from.transform().copy());
  return result;
}

// Null where the grid is not From.
template <class To, class From>
typename To::Ptr converted(const openvdb::GridBase::Ptr& grid) {
  if (!grid->isType<From>()) return nullptr;
  if constexpr (std::is_same_v<To, From>)
    return openvdb::gridPtrCast<To>(grid);
  else
    return withValuesOf<To>(static_cast<const From&>(*grid));
}

template <class To, class... From>
typename To::Ptr convertedFromAny(const openvdb::GridBase::Ptr& grid) {
  typename To::Ptr result;
  (void)((result = converted<To, From>(grid)) || ...);
  return result;
}

// Refuses what cannot be given, before its voxels are read.
void checkHead(const GridHead& head, bool vectors) {
  const std::string its = "cannot be used: its grid " + quoted(head.name);
  if (!head.transform)
    throw Unreadable(asClause(its + " has a transform that is not affine or leads nowhere, and voxels that "
                                    "are all alike are needed"));
  if (head.readable && head.vectors == vectors) return;
  throw Unreadable(asClause(its + " holds " +
                            (!head.readable ? "values of the type " + head.type
                             : head.vectors ? "vectors"
                                            : "single numbers") +
                            ", and " + (vectors ? "vectors" : "single numbers") + " are needed"));
}

// Goes to the first grid of the name.
void find(GridFile& grids, const std::string& name) {
  std::string others;
  while (grids.next()) {
    if (grids.head().name == name) return;
    others += (others.empty() ? "" : ", ") + quoted(grids.head().name);
  }
  throw Unreadable(asClause("holds no grid " + quoted(name) +
                            (others.empty() ? ", and no other" : ", but these: " + others)));
}

template <class Grid, class... From>
void give(GridFile& grids, std::ostream& out) {
  const typename Grid::Ptr grid = convertedFromAny<Grid, Grid, From...>(grids.read());
  if (!grid) throw Unreadable("is no OpenVDB file that can be read: it is damaged");
  refuseNonFinite(*grid, "cannot be used: its grid " + asClause(quoted(grid->getName())));
  grid->setSaveFloatAsHalf(false);
  write(grid, out);
}

}  // namespace

void prepareForGrids() {
  openvdb::initialize();
  // Threads take addresses, of which a process that reads has few.
  static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
}

// A damaged file may say that a name has 4 GB, which would be made and cleared before it is missed. What a
// file holds uncompressed whatever its values are the masks of its nodes, two bits a value (four in leaves):
// of vectors of doubles, 32 bytes in memory, and 16 once they are floats. That is 192 bytes a byte of the
// file, and something for each node. Large files hold values: halves, which take twice as much as floats,
// and are packed to a tenth where they hardly change.
std::uint64_t mostMemoryOfGrid(const std::filesystem::path& file) {
  constexpr std::uint64_t kLeast = 8ull << 20, kPerByte = 256, kPerByteOfLarge = 32, kLargest = 1ull << 40;
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown) return kMostMemory;
  const std::uint64_t bytes = std::min<std::uint64_t>(size, kLargest);
  return std::min(kLeast + kPerByte * bytes, std::max(kMostMemory, kPerByteOfLarge * bytes));
}

std::vector<GridHead> listGrids(const std::filesystem::path& file) {
  return inWords([&] {
    std::vector<GridHead> heads;
    for (GridFile grids(file); grids.next();) heads.push_back(grids.head());
    return heads;
  });
}

void readGrid(const std::filesystem::path& file, bool vectors, std::ostream& out) {
  inWords([&] {
    const std::string type = vectors ? Vec3SGrid::gridType() : FloatGrid::gridType();
    GridFile grids(file);
    do {
      if (!grids.next())
        throw Unreadable(vectors ? "holds no grid of float vectors" : "holds no grid of floats");
    } while (grids.type() != type || grids.isInstance());
    const openvdb::GridBase::Ptr grid = grids.read();
    if (!isUsable(grid->transform())) throw Unreadable("has a transform that leads nowhere");
    write(grid, out);
  });
}

void readGrid(const std::filesystem::path& file, const std::string& name, bool vectors, std::ostream& out) {
  inWords([&] {
    GridFile grids(file);
    find(grids, name);
    checkHead(grids.head(), vectors);
    if (vectors)
      give<Vec3SGrid, openvdb::Vec3DGrid, openvdb::Vec3IGrid>(grids, out);
    else
      give<FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid, openvdb::BoolGrid>(grids,
                                                                                                      out);
  });
}

}  // namespace fluidtex::foreign::here
