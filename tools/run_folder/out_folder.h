// Output folder of a command.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

// Who else may write into the folder: nobody, or others that say so too, each of them other files.
enum class Holding { alone, together };

// Locked for the lifetime of this object and at most of the process. Contains no links for what a run writes
// or removes, so that all of it is inside the folder.
class OutFolder {
 public:
  // Creates the folder if missing. Throws UsageError, with the folder's name, if it cannot be created or
  // written, if another process holds it, or if something that a run writes or removes is a link.
  explicit OutFolder(const std::filesystem::path& folder, Holding holding = Holding::alone);
  ~OutFolder();
  OutFolder(const OutFolder&) = delete;
  OutFolder& operator=(const OutFolder&) = delete;

 private:
  std::filesystem::path m_lock;
  int m_descriptor = -1;
};

}  // namespace fluidtex::tools
