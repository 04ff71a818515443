// A file of grids, one grid after the other: in a process that may come to harm.
#pragma once

#include "foreign/grid.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace fluidtex::foreign::here {

// Places can be found with it, there and back.
bool isUsable(const openvdb::math::Transform& transform);

// It ends where its bytes do: the library's own goes on behind the end of a file that is cut short, over
// values that are not there, for as many as the file says there are. And it knows grids of types that the
// library does not. What is called throws Unreadable, std::ios_base::failure or openvdb::Exception.
class GridFile : public openvdb::io::Archive {
 public:
  explicit GridFile(const std::filesystem::path& file);

  // Goes on to the next grid, the first to begin with; false behind the last one, and where the next cannot
  // be found: behind a grid of an unknown type in a file that was written as a stream.
  bool next();

  // Of the grid that next() has found.
  const GridHead& head() const { return m_head; }
  // The library's name of its type, without what it says of half floats.
  const std::string& type() const { return m_descriptor.gridType(); }
  // Shares the tree of another.
  bool isInstance() const { return m_descriptor.isInstance(); }

  // That grid, for once; of a type that the library knows.
  openvdb::GridBase::Ptr read();

 private:
  void readHead();
  void skipVoxels();

  std::filesystem::path m_file;
  std::unique_ptr<char[]> m_buffer;
  std::ifstream m_in;
  openvdb::io::StreamMetadata::Ptr m_metadata = std::make_shared<openvdb::io::StreamMetadata>();
  openvdb::io::GridDescriptor m_descriptor;
  GridHead m_head;
  std::streampos m_begin;  // of what follows the descriptor
  int m_left = 0;          // grids
  bool m_inside = false;   // of a grid, not yet behind it
};

}  // namespace fluidtex::foreign::here
