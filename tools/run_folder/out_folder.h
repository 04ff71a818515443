// Output folder of a command.
#pragma once

#include <filesystem>

namespace fluidtex::tools {

// Lock on the folder: exclusive, or shared with processes that also take a shared lock and write other files.
enum class Holding { alone, together };

// Lock on an output folder while this object lives; the system releases it when the process ends. What a run
// writes or removes in the folder is no symbolic link, so that nothing outside the folder changes.
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
