#include "sim/grid/write_grids.h"

#include <openvdb/io/Archive.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

namespace fluidtex::sim {
namespace {

// Writes what openvdb::io::File does, to a stream of ours: File does not check its own after opening it, and
// does not report when the disk refuses.
class Archive : public openvdb::io::Archive {
 public:
  void put(std::ostream& out, const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata) const {
    openvdb::io::Archive::write(out, grids, true, metadata);
  }
};

// Writes to the disk in blocks of its buffer, however large the parts are that it gets. std::filebuf passes
// each part of a kilobyte or more on by itself, a leaf at a time.
class BlockBuffer : public std::filebuf {
 protected:
  std::streamsize xsputn(const char* data, std::streamsize size) override {
    std::streamsize done = 0;
    while (done < size) {
      const auto room = std::min<std::streamsize>(epptr() - pptr(), size - done);
      if (room > 0) {
        std::memcpy(pptr(), data + done, static_cast<std::size_t>(room));
        pbump(static_cast<int>(room));
        done += room;
      } else if (overflow(traits_type::to_int_type(data[done++])) == traits_type::eof()) {
        return done - 1;
      }
    }
    return done;
  }
};

}  // namespace

void writeGrids(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata,
                const std::filesystem::path& file) {
  openvdb::initialize();
  std::vector<char> buffer(std::size_t{1} << 20);
  BlockBuffer blocks;
  blocks.pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  std::ostream stream(&blocks);
  if (blocks.open(file, std::ios::out | std::ios::binary | std::ios::trunc) == nullptr)
    stream.setstate(std::ios::failbit);
  Archive archive;
  archive.setCompression(openvdb::io::COMPRESS_NONE);
  if (stream) archive.put(stream, grids, metadata);
  if (blocks.close() == nullptr || !stream)
    throw openvdb::IoError(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace fluidtex::sim
