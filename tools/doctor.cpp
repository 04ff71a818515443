// fluidtex doctor: what is installed and works, what is missing and what that is needed for.
#include "render/other_program.h"
#include "render/render.h"
#include "texture/exemplar/read_image.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"
#include "tools/draw_by_cycles.h"
#include "tools/run_folder/cache_folder.h"
#include "tools/summaries/contact_sheet.h"

#include <fmt/core.h>
#include <openvdb/openvdb.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// A program that is started by name, what for, and where it comes from.
struct Helper {
  std::vector<std::string> version;  // the command that prints it
  const char* use;
  const char* package;  // of Debian
};

const std::vector<Helper> kOptional = {
    {{"gnuplot", "--version"}, "plots of fluidtex validate --plots", "gnuplot-nox"},
    {{"python3", "--version"}, "tools/measure_synthesis, --docs of tools/bench and others", "python3"},
    {{"blender", "--version"}, "fluidtex render --cycles, caches to try", "blender"},
    {{"sbatch", "--version"}, "tools/farm", "slurm-client"},
    {{"clang", "--version"}, "tools/fuzz", "clang"},
};

std::string firstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

// A folder of its own that goes at the end.
struct Scratch {
  fs::path path;
  Scratch() {
    std::string pattern = (fs::temp_directory_path() / "fluidtex-doctor-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error(fs::temp_directory_path().string() + ": no folder can be made there");
    path = pattern;
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
};

render::Picture greyPicture() {
  return {64, 48, std::vector<float>(64 * 48 * 3, 0.5f)};
}

// Bytes of a line "NAME: N kB" of /proc/meminfo; 0 where there is none.
double memory(const std::string& name) {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(name + ":")) return 1024.0 * std::stod(line.substr(name.size() + 1));
  return 0.0;
}

// Of the group of processes that this one is in, as containers are; nothing where there is none.
std::optional<double> memoryLimit() {
  std::ifstream in("/sys/fs/cgroup/memory.max");
  double bytes = 0.0;
  return in >> bytes ? std::optional(bytes) : std::nullopt;
}

class Doctor {
 public:
  int run() {
    about();
    needed("reads pictures", "apt-get install the packages of tools/packages.txt, and build again", [&] {
      const fs::path file = m_scratch.path / "0001.png";
      writePng(greyPicture(), file);
      if (texture::readImage(file).width != 64) throw std::runtime_error("a picture comes back otherwise");
    });
    needed("makes videos", "apt-get install ffmpeg", [&] {
      render::writeVideo(m_scratch.path, 1, 1, 24.0, m_scratch.path / "video.mp4");
      m_found = firstLine(render::runOther({"ffmpeg", "-version"}).output);
      m_found = m_found.substr(0, m_found.find(" Copyright"));
    });
    needed("draws contact sheets", "build again: fluidtex_sheet is to lie beside fluidtex", [&] {
      writeContactSheets({{{{m_scratch.path / "0001.png", "label"}}, 1, 64, m_scratch.path / "sheet.jpg"}});
    });
    needed("keeps tables", "make the folder writable, or set XDG_CACHE_HOME; runs begin slower without it",
           [&] { keepsTables(); });
    for (const Helper& helper : kOptional) optional(helper);
    scripts();
    return m_good ? kDone : kFailed;
  }

 private:
  static void line(const std::string& mark, const std::string& what, const std::string& more) {
    print("{:<8} {:<21} {}\n", mark, what, more);
  }

  static void about() {
    line("", "fluidtex", FLUIDTEX_VERSION);
    line("", "libraries",
         fmt::format("OpenVDB {}, oneTBB {}", OPENVDB_LIBRARY_VERSION_STRING, TBB_VERSION_STRING));
    line("", "threads", fmt::format("{}", tbb::this_task_arena::max_concurrency()));
    const std::optional<double> limit = memoryLimit();
    line("", "memory",
         fmt::format("{:.1f} GB, {:.1f} GB of it free{}", memory("MemTotal") / 1e9,
                     memory("MemAvailable") / 1e9,
                     limit ? fmt::format("; limited to {:.1f} GB here", *limit / 1e9) : ""));
    std::error_code unknown;
    const fs::space_info space = fs::space(".", unknown);
    if (!unknown)
      line("", "disk", fmt::format("{:.0f} GB free in this folder", double(space.available) / 1e9));
  }

  // What a run cannot do without.
  void needed(const std::string& what, const std::string& remedy, const std::function<void()>& attempt) {
    m_found.clear();
    try {
      attempt();
      line("ok", what, m_found);
    } catch (const std::exception& error) {
      m_good = false;
      line("FAILS", what, fmt::format("{}; {}", error.what(), remedy));
    }
  }

  void keepsTables() {
    const fs::path folder = cacheFolder();
    if (folder.empty()) throw std::runtime_error("neither XDG_CACHE_HOME nor HOME is set");
    std::error_code missing;
    fs::create_directories(folder, missing);
    if (access(folder.c_str(), W_OK) != 0) throw std::runtime_error(folder.string() + " cannot be written");
    double bytes = 0.0;
    for (const auto& entry : fs::recursive_directory_iterator(folder, missing))
      if (entry.is_regular_file(missing)) bytes += double(entry.file_size(missing));
    m_found = fmt::format("{}, {:.2f} GB", folder.string(), bytes / 1e9);
  }

  static void optional(const Helper& helper) {
    try {
      const render::Outcome found = render::runOther(helper.version);
      if (found.exitCode == 0)
        return line("ok", helper.version[0], fmt::format("{}: {}", firstLine(found.output), helper.use));
    } catch (const std::runtime_error&) {
    }
    line("missing", helper.version[0],
         fmt::format("not needed for runs; {}: apt-get install {}", helper.use, helper.package));
  }

  static void scripts() {
    try {
      line("ok", "scripts for Blender", blenderScripts().string());
    } catch (const std::runtime_error& error) {
      line("missing", "scripts for Blender", fmt::format("not needed for runs; {}", error.what()));
    }
  }

  Scratch m_scratch;
  std::string m_found;
  bool m_good = true;
};

}  // namespace

Command doctorCommand() {
  Command command{"doctor", "Print what is installed, what is missing and what for"};
  command.footer = "Exit status: 0 where everything that a run needs works, else 2.";
  command.run = [] { return Doctor().run(); };
  return command;
}

}  // namespace fluidtex::tools
