#include "foreign/read_grid.h"

#include "foreign/limits.h"

#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <ios>
#include <memory>
#include <sstream>

namespace fluidtex::foreign::here {
namespace {

// A file of grids that ends where its bytes do. The library's own goes on behind the end of a file that is
// cut short, over values that are not there, for as many as the file says there are.
class GridFile : public openvdb::io::Archive {
 public:
  explicit GridFile(const std::filesystem::path& file) : m_in(file, std::ios::binary) {
    if (!m_in) throw Unreadable("is no OpenVDB file that can be read: it cannot be opened");
    m_in.exceptions(std::ios::failbit | std::ios::badbit);
    readHeader(m_in);
    openvdb::io::setStreamMetadataPtr(m_in, m_metadata);
    setFormatVersion(m_in);
    setLibraryVersion(m_in);
    setDataCompression(m_in);
    openvdb::MetaMap().readMeta(m_in);
  }

  // Null where there is none of the type. One that shares the tree of another comes after that.
  openvdb::GridBase::Ptr first(const std::string& type) {
    for (int left = readGridCount(m_in); left > 0; --left) {
      openvdb::io::GridDescriptor descriptor;
      const openvdb::GridBase::Ptr grid = descriptor.read(m_in);
      const bool wanted = grid->type() == type && !descriptor.isInstance();
      if (wanted && inputHasGridOffsets()) descriptor.seekToGrid(m_in);
      if (wanted || !inputHasGridOffsets()) readGrid(grid, descriptor, m_in);
      if (wanted) return grid;
      if (inputHasGridOffsets()) descriptor.seekToEnd(m_in);
    }
    return nullptr;
  }

 private:
  std::ifstream m_in;
  openvdb::io::StreamMetadata::Ptr m_metadata = std::make_shared<openvdb::io::StreamMetadata>();
};

// Places in it can be found, there and back.
bool isUsable(const openvdb::math::Transform& transform) {
  for (const openvdb::Vec3d& index : {openvdb::Vec3d(0.0), openvdb::Vec3d(1.0, 2.0, 3.0)}) {
    const openvdb::Vec3d world = transform.indexToWorld(index), back = transform.worldToIndex(world);
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(world[axis]) || !(std::abs(back[axis] - index[axis]) < 1e-3)) return false;
  }
  return true;
}

}  // namespace

void prepareForGrids() {
  openvdb::initialize();
}

// A damaged file may say that a name has 4 GB, which would be made and cleared before it is missed. What a
// file holds uncompressed whatever its values are the masks of its nodes, two bits a value (four in leaves):
// of vectors, 16 bytes in memory, 12 in the stream, which while it grows takes three times as much. That is
// 64 and 3 times 48 bytes a byte of the file, and something for each node.
std::uint64_t mostMemoryOfGrid(const std::filesystem::path& file) {
  constexpr std::uint64_t kLeast = 8ull << 20, kPerByte = 256;
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  return unknown || bytes > kMostMemory / kPerByte ? kMostMemory
                                                   : std::min(kMostMemory, kLeast + kPerByte * bytes);
}

std::string readGrid(const std::filesystem::path& file, bool vectors) {
  const std::string type = vectors ? openvdb::Vec3SGrid::gridType() : openvdb::FloatGrid::gridType();
  try {
    const openvdb::GridBase::Ptr grid = GridFile(file).first(type);
    if (!grid) throw Unreadable(vectors ? "holds no grid of float vectors" : "holds no grid of floats");
    if (!isUsable(grid->transform())) throw Unreadable("has a transform that leads nowhere");
    std::ostringstream out;
    openvdb::io::Stream stream(out);
    stream.setCompression(openvdb::io::COMPRESS_NONE);  // which would drop inactive values
    stream.write(openvdb::GridCPtrVec{grid});
    return std::move(out).str();
  } catch (const openvdb::Exception& error) {
    throw Unreadable("is no OpenVDB file that can be read (" + asClause(error.what()) + ")");
  } catch (const std::ios_base::failure&) {
    throw Unreadable("is no OpenVDB file that can be read: it is damaged or cut short");
  }
}

}  // namespace fluidtex::foreign::here
