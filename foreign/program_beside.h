// Where the programs lie that do a part of the work in a process of their own.
#pragma once

#include <filesystem>
#include <string>

namespace fluidtex::foreign {

// Beside the program that runs, or else where it was built.
inline std::filesystem::path programBeside(const std::string& name, const std::filesystem::path& built) {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path beside = self.parent_path() / name;
  return std::filesystem::exists(beside, ignored) ? beside : built;
}

}  // namespace fluidtex::foreign
