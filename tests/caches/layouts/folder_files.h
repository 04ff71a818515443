// Folders of caches, of files that hold as much as their layout is told by.
#pragma once

#include "caches/layouts/numbered_files.h"
#include "tests/scratch.h"

#include <openvdb/openvdb.h>

#include <catch2/catch.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace fluidtex::caches {

namespace fs = std::filesystem;

inline void writeFile(const fs::path& file, const std::string& bytes = "x") {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

inline openvdb::FloatGrid::Ptr numbers(const std::string& name,
                                       openvdb::GridClass of = openvdb::GRID_UNKNOWN) {
  openvdb::initialize();
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(1.0f);
  grid->tree().setValue(openvdb::Coord(0), -1.0f);
  grid->setName(name);
  grid->setGridClass(of);
  return grid;
}

inline openvdb::Vec3SGrid::Ptr vectors(const std::string& name,
                                       openvdb::GridClass of = openvdb::GRID_UNKNOWN) {
  openvdb::initialize();
  const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create();
  grid->tree().setValue(openvdb::Coord(0), openvdb::Vec3s(1.0f));
  grid->setName(name);
  grid->setGridClass(of);
  return grid;
}

inline void writeGrids(const fs::path& file, const openvdb::GridCPtrVec& grids) {
  fs::create_directories(file.parent_path());
  openvdb::initialize();
  openvdb::io::File(file.string()).write(grids);
}

// A triangle, or as many points, with velocities where `names` are those of three numbers.
inline std::string plyBytes(bool triangle, const std::vector<std::string>& names = {}) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  for (const std::string& name : names) text += "property float " + name + "\n";
  if (triangle) text += "element face 1\nproperty list uchar int vertex_indices\n";
  text += "end_header\n";
  for (const char* point : {"0 0 0", "1 0 0", "0 1 0"}) {
    text += point;
    for (std::size_t n = 0; n < names.size(); ++n) text += " 1";
    text += "\n";
  }
  return text + (triangle ? "3 0 1 2\n" : "");
}

// The sentence that `call` is refused with; empty where it is not.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const LayoutError& error) {
    const std::string sentence = error.what();
    CHECK(sentence.find('\n') == std::string::npos);
    return sentence;
  }
  return {};
}

}  // namespace fluidtex::caches
