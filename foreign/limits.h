// What a process that reads a file of others may do.
#pragma once

#include <cstdint>
#include <filesystem>

namespace fluidtex::foreign {

inline constexpr std::uint64_t kMostMemory = 1536ull << 20;  // bytes

// Of this process, from now on: 6 s of processor time and one more a megabyte of the file, three times as
// many in all, `memory` bytes more than it has, no byte written to a file, no core, and its end where its
// parent ends.
void limitThisProcess(const std::filesystem::path& file, std::uint64_t memory);

// Another second for each 5 million pixels that the file says it has: some say much in few bytes.
void allowTimeFor(std::int64_t pixels);

}  // namespace fluidtex::foreign
