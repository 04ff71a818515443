// Scene files written by the tests, in a folder of their own that goes when the test ends.
#pragma once

#include "scenes/scene.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace fluidtex::scenes {

class SceneFolder {
 public:
  SceneFolder() {
    static int count = 0;
    m_path = std::filesystem::temp_directory_path() /
             ("fluidtex_scenes_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
    std::filesystem::create_directories(m_path / "pictures");
    write("e.png", "");  // only its presence is looked at
    write("m.obj", "");
    write("f.vdb", "");
    write("m_0.obj", "");
    write("m_1.obj", "");
    write("m_2.obj", "");
    for (const char* name : {"t_0.obj", "t_1.obj", "t_2.obj", "t_3.obj", "t_4.obj"}) write(name, "");
  }
  ~SceneFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  const std::filesystem::path& path() const { return m_path; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(m_path / name, std::ios::binary) << text;
    return m_path / name;
  }

 private:
  std::filesystem::path m_path;
};

// Lines 1 to 5 of a scene that is right; what comes after them starts at line 6.
inline const std::string kGoodScene =
    "texture.exemplar = 'e.png'\n"
    "domain.size = [2, 1, 1]\n"
    "\n"
    "[[liquid]]\n"
    "box = { min = [0, 0, 0], max = [1, 1, 0.5] }\n";

// The faults of a scene with this text in a file "s.toml"; the folder's name is left out of them.
inline std::vector<std::string> faultsOf(const std::string& text, const Overrides& overrides = {}) {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", text);
  std::vector<std::string> faults;
  try {
    loadScene(file, overrides);
  } catch (const SceneError& error) {
    faults = error.faults;
  }
  const std::string prefix = folder.path().string() + "/";
  for (std::string& fault : faults) {
    for (std::size_t at = fault.find(prefix); at != std::string::npos; at = fault.find(prefix))
      fault.erase(at, prefix.size());
  }
  return faults;
}

inline std::string textOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

}  // namespace fluidtex::scenes
