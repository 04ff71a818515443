// fluidtex_stress: random scenes, and what must hold in all of them. See tools/stress.
#include "tools/frames/progress.h"
#include "tools/stress_scenes/in_own_process.h"
#include "tools/stress_scenes/random_scene.h"
#include "tools/stress_scenes/smallest.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>

#include <unistd.h>

namespace fluidtex::stress {
namespace {

namespace fs = std::filesystem;

struct Settings {
  int count = 100;
  std::uint64_t seed = 1;
  std::vector<int> only;
  std::vector<fs::path> files;
  fs::path out = "build/stress";
  double seconds = 600.0;
  bool small = false;
};

void writeText(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(file.string() + " cannot be written");
}

bool holds(const std::vector<Failure>& failures, const std::string& invariant) {
  return std::none_of(failures.begin(), failures.end(),
                      [&](const Failure& failure) { return failure.invariant == invariant; });
}

class Runs {
 public:
  explicit Runs(const Settings& settings) : m_settings(settings) { fs::create_directories(settings.out); }

  // Whether all held.
  bool run() {
    const int count =
        static_cast<int>(!m_settings.files.empty()  ? m_settings.files.size()
                         : !m_settings.only.empty() ? m_settings.only.size()
                                                    : static_cast<std::size_t>(m_settings.count));
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < count; ++n) {
      if (!m_settings.files.empty()) {
        one(m_settings.files[n].string(), m_settings.files[n], {});
      } else {
        const int number = m_settings.only.empty() ? n : m_settings.only[n];
        const SceneParts parts = randomScene(m_settings.seed, number);
        const fs::path file = m_settings.out / fmt::format("seed{}_scene{}.toml", m_settings.seed, number);
        writeText(file, textOf(parts));
        if (one(fmt::format("scene {} of seed {}", number, m_settings.seed), file, parts)) fs::remove(file);
      }
      const double gone = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      fmt::print(stderr, "{} of {} done, {} failed, {} left\n", n + 1, count, m_failed,
                 tools::humanDuration(gone / (n + 1) * (count - n - 1)));
    }
    summary(count);
    return m_failed == 0;
  }

 private:
  bool one(const std::string& name, const fs::path& file, const SceneParts& parts) {
    const std::vector<Failure> failures = checkInOwnProcess(file, m_settings.out, m_settings.seconds);
    for (const Failure& failure : failures) {
      ++m_byInvariant[failure.invariant];
      fmt::print("{}: {}: {}; frame {}; {}\n", name, failure.invariant, failure.what, failure.frame,
                 file.string());
      std::fflush(stdout);
    }
    if (m_settings.small && !parts.empty()) {
      for (const Failure& failure : failures) shrink(failure.invariant, file, parts);
    }
    m_failed += failures.empty() ? 0 : 1;
    return failures.empty();
  }

  void shrink(const std::string& invariant, const fs::path& file, const SceneParts& parts) const {
    fs::path smaller = file;
    smaller.replace_filename(file.stem().string() + "_" + invariant + ".toml");
    const fs::path trial = m_settings.out / "trial.toml";
    const auto fails = [&](const SceneParts& some) {
      writeText(trial, textOf(some));
      if (holds(checkInOwnProcess(trial, m_settings.out, m_settings.seconds, invariant), invariant))
        return false;
      fs::rename(trial, smaller);
      return true;
    };
    writeText(smaller, textOf(parts));
    smallest(parts, fails);
    fs::remove(trial);
    fmt::print("  smaller: {}\n", smaller.string());
  }

  void summary(int count) const {
    fmt::print("{} scenes, {} failed\n", count, m_failed);
    for (const auto& [invariant, times] : m_byInvariant) fmt::print("  {:<10} {:>5}\n", invariant, times);
  }

  const Settings& m_settings;
  int m_failed = 0;
  std::map<std::string, int> m_byInvariant;
};

}  // namespace
}  // namespace fluidtex::stress

namespace {

int run(int argc, char** argv) {
  fluidtex::stress::Settings settings;
  CLI::App app("Runs random scenes and checks what must hold in all of them.", "tools/stress");
  app.add_option("N", settings.count, "how many scenes")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("SEED", settings.seed, "other seeds give other scenes")->capture_default_str();
  app.add_option("--only", settings.only, "only these of the seed's scenes, numbered from 0");
  app.add_option("--file", settings.files, "these scene files instead")->check(CLI::ExistingFile);
  app.add_option("--out", settings.out, "folder for the scenes that fail")->capture_default_str();
  app.add_option("--seconds", settings.seconds, "the longest that a scene may take")->capture_default_str();
  app.add_flag("--small", settings.small, "leave out of each scene that fails what it fails without");
  CLI11_PARSE(app, argc, argv);
  return fluidtex::stress::Runs(settings).run() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tools/stress: %s\n", error.what());
    return 2;
  }
}
