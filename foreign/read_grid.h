// The reader's side of foreign/grid.h: called in a process that may come to harm.
#pragma once

#include "foreign/grid.h"

#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace fluidtex::foreign::here {

// What is the same for all files; to be called once.
void prepareForGrids();

// Bytes that reading the file may take: as much as grids can that are as empty as can be, at most
// kMostMemory, or more for files that are large themselves.
std::uint64_t mostMemoryOfGrid(const std::filesystem::path& file);

// As foreign::listGrids().
std::vector<GridHead> listGrids(const std::filesystem::path& file);

// The first grid of floats, or of float vectors, of an OpenVDB file, written anew as a stream: what comes
// back is whole, however damaged the file was that could still be read. Throws Unreadable.
void readGrid(const std::filesystem::path& file, bool vectors, std::ostream& out);

// The same of the first grid of this name, as foreign::readGrid().
void readGrid(const std::filesystem::path& file, const std::string& name, bool vectors, std::ostream& out);

}  // namespace fluidtex::foreign::here
