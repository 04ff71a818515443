#include "tools/run_folder/cache_folder.h"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>
#include <string>

namespace {

// Sets the variables for as long as it lives; empty: not set.
class Environment {
 public:
  explicit Environment(const std::map<std::string, std::string>& wanted) {
    for (const auto& [name, value] : wanted) {
      const char* before = std::getenv(name.c_str());
      m_before[name] = before ? before : "";
      set(name, value);
    }
  }
  ~Environment() {
    for (const auto& [name, value] : m_before) set(name, value);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  static void set(const std::string& name, const std::string& value) {
    if (value.empty())
      unsetenv(name.c_str());
    else
      setenv(name.c_str(), value.c_str(), 1);
  }
  std::map<std::string, std::string> m_before;
};

}  // namespace

TEST_CASE("cache folder: where the user has said, else in the home folder, else nowhere", "[tools]") {
  using fluidtex::tools::cacheFolder;
  {
    const Environment environment({{"XDG_CACHE_HOME", "/kept"}, {"HOME", "/home/me"}});
    CHECK(cacheFolder() == "/kept/fluidtex");
  }
  {
    const Environment environment({{"XDG_CACHE_HOME", "relative"}, {"HOME", "/home/me"}});
    CHECK(cacheFolder() == "/home/me/.cache/fluidtex");
  }
  {
    const Environment environment({{"XDG_CACHE_HOME", ""}, {"HOME", "/home/me"}});
    CHECK(cacheFolder() == "/home/me/.cache/fluidtex");
  }
  const Environment environment({{"XDG_CACHE_HOME", ""}, {"HOME", ""}});
  CHECK(cacheFolder().empty());
}
