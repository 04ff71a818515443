#include "tools/run_folder/cache_folder.h"

#include <cstdlib>

namespace fluidtex::tools {

std::filesystem::path cacheFolder() {
  const auto absolute = [](const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path folder = value ? value : "";
    return folder.is_absolute() ? folder : std::filesystem::path();
  };
  if (const auto cache = absolute("XDG_CACHE_HOME"); !cache.empty()) return cache / "fluidtex";
  if (const auto home = absolute("HOME"); !home.empty()) return home / ".cache" / "fluidtex";
  return {};
}

}  // namespace fluidtex::tools
