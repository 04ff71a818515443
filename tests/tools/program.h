// Starts the program as a user would, in a process of its own.
#pragma once

#include "tests/scratch.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

using Words = std::vector<std::string>;

inline Words plus(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

struct Finished {
  int exitCode = -1;     // -1: ended by a signal
  std::string out, err;  // what it printed
  std::string all() const { return out + err; }
};

class RunningProgram {
 public:
  // `fluidtex ARGS...`, in the folder `from` where given, with `path` in front of PATH where given. `setUp`:
  // done in the new process, last of all.
  explicit RunningProgram(const std::vector<std::string>& args, const std::filesystem::path& from = {},
                          const std::filesystem::path& path = {}, const std::function<void()>& setUp = {}) {
    const std::string searched = path.empty() ? "" : path.string() + ":" + std::getenv("PATH");
    const std::string cache = (m_scratch.path / "cache").string();
    m_child = fork();
    if (m_child != 0) return;
    redirect(STDOUT_FILENO, m_scratch.path / "out");
    redirect(STDERR_FILENO, m_scratch.path / "err");
    if (!from.empty() && chdir(from.c_str()) != 0) _exit(126);
    if (!path.empty()) setenv("PATH", searched.c_str(), 1);
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    std::vector<char*> argv{const_cast<char*>(FLUIDTEX_PROGRAM)};
    for (const std::string& arg : args) argv.push_back(const_cast<char*>(arg.c_str()));
    argv.push_back(nullptr);
    if (setUp) setUp();
    execv(FLUIDTEX_PROGRAM, argv.data());
    _exit(127);
  }

  pid_t id() const { return m_child; }
  void signal(int number) const { kill(m_child, number); }

  // Waits until `file` has grown by this many lines since it had `before`, or the program has ended.
  void waitForLines(const std::filesystem::path& file, long before, long lines) const {
    while (!ended() && countLines(file) < before + lines)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  Finished wait() const {
    int status = 0;
    waitpid(m_child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readBytes(m_scratch.path / "out"),
            readBytes(m_scratch.path / "err")};
  }

  static long countLines(const std::filesystem::path& file) {
    const std::string text = readBytes(file);
    return std::count(text.begin(), text.end(), '\n');
  }

 private:
  static void redirect(int stream, const std::filesystem::path& file) {
    dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), stream);
  }

  bool ended() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(m_child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
           info.si_pid != 0;
  }

  Scratch m_scratch;
  pid_t m_child = 0;
};

inline Finished runProgram(const std::vector<std::string>& args, const std::filesystem::path& from = {}) {
  return RunningProgram(args, from).wait();
}

// The same, with what `setUp` does in the new process: limits, other streams, variables.
inline Finished runProgramWith(const std::function<void()>& setUp, const std::vector<std::string>& args) {
  return RunningProgram(args, {}, {}, setUp).wait();
}

inline const std::string kSmallScene = FLUIDTEX_SOURCE "/tests/tools/small.toml";

// frames/ and surface/ as name -> bytes: what must not depend on threads, kills or the clock.
using Results = std::vector<std::pair<std::string, std::string>>;

inline Results resultsIn(const std::filesystem::path& out) {
  Results files;
  for (const char* folder : {"frames", "surface"})
    if (std::filesystem::exists(out / folder))
      for (const std::string& name : filesIn(out / folder))
        files.emplace_back(folder + ("/" + name), readBytes(out / folder / name));
  return files;
}

inline std::vector<std::string> namesOf(const Results& files) {
  std::vector<std::string> names;
  for (const auto& file : files) names.push_back(file.first);
  return names;
}

// The files of `part` that are not in `whole`, or not with the same bytes.
inline std::vector<std::string> differing(const Results& part, const Results& whole) {
  std::vector<std::string> names;
  for (const auto& file : part)
    if (std::find(whole.begin(), whole.end(), file) == whole.end()) names.push_back(file.first);
  return names;
}

inline long occurrences(const std::string& text, const std::string& words) {
  long count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}
