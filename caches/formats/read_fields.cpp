#include "caches/formats/read_fields.h"

#include "caches/formats/format_error.h"
#include "foreign/grid.h"

#include <openvdb/io/Stream.h>

#include <tbb/task_arena.h>

#include <ios>

namespace fluidtex::caches {
namespace {

template <class Grid>
typename Grid::Ptr readField(const std::filesystem::path& file, const std::string& name, bool vectors) {
  openvdb::initialize();  // which the stream's grids ask for; once is enough, and more does no harm
  try {
    typename Grid::Ptr grid;
    foreign::readGrid(file, name, vectors, [&](std::istream& stream) {
      // Whoever waits here must not take up other work that wants to read a file, too.
      tbb::this_task_arena::isolate([&] {
        openvdb::io::Stream grids(stream, false);  // no delayed loading
        grid = openvdb::gridPtrCast<Grid>(grids.getGrids()->at(0));
      });
    });
    return grid;
  } catch (const foreign::Unreadable& error) {
    throw FormatError(file.string() + ": " + error.what());
  } catch (const openvdb::Exception& error) {
    throw FormatError(file.string() + ": cannot be read (" + foreign::asClause(error.what()) + ")");
  } catch (const std::ios_base::failure&) {
    throw FormatError(file.string() + ": cannot be read: what its reader gives is cut short");
  }
}

}  // namespace

openvdb::FloatGrid::Ptr readScalars(const std::filesystem::path& file, const std::string& name) {
  return readField<openvdb::FloatGrid>(file, name, false);
}

openvdb::Vec3SGrid::Ptr readVectors(const std::filesystem::path& file, const std::string& name) {
  return readField<openvdb::Vec3SGrid>(file, name, true);
}

}  // namespace fluidtex::caches
