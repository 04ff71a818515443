// The folder that a command writes into.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

// Held by one process at a time, as long as this lives and no longer than the process does; and nothing in it
// leads out of it, so that what a run writes or removes there is there.
class OutFolder {
 public:
  // Makes the folder where it is missing. Throws UsageError, with the folder's name, where it can be neither
  // made nor written into, another process holds it, or something that a run writes or removes is a link.
  explicit OutFolder(const std::filesystem::path& folder);
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  std::filesystem::path m_lock;
  int m_descriptor = -1;
};

}  // namespace fluidtex::tools
