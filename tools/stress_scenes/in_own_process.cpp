#include "tools/stress_scenes/in_own_process.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>
#include <system_error>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fluidtex::stress {
namespace {

// One failure a line: frame, invariant, what.
void write(int pipe, const std::vector<Failure>& failures) {
  std::string text;
  for (Failure failure : failures) {
    std::replace(failure.what.begin(), failure.what.end(), '\n', ' ');
    text += fmt::format("{} {} {}\n", failure.frame, failure.invariant, failure.what);
  }
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = ::write(pipe, text.data() + at, text.size() - at);
    if (written <= 0) return;
    at += static_cast<std::size_t>(written);
  }
}

std::vector<Failure> parsed(const std::string& text) {
  std::vector<Failure> failures;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    Failure failure;
    words >> failure.frame >> failure.invariant;
    std::getline(words >> std::ws, failure.what);
    failures.push_back(failure);
  }
  return failures;
}

}  // namespace

std::vector<Failure> checkInOwnProcess(const std::filesystem::path& file,
                                       const std::filesystem::path& scratch, double seconds,
                                       const std::string& wanted) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "a pipe");
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "a process");
  if (child == 0) {
    close(ends[0]);
    write(ends[1], checkScene(file, scratch, wanted));
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  bool late = false;
  const auto start = std::chrono::steady_clock::now();
  for (char buffer[4096];;) {
    const double gone = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    pollfd wait{ends[0], POLLIN, 0};
    if (gone >= seconds || poll(&wait, 1, static_cast<int>(1000.0 * (seconds - gone)) + 1) == 0) {
      late = true;
      kill(child, SIGKILL);
      break;
    }
    const ssize_t got = read(ends[0], buffer, sizeof buffer);
    if (got <= 0) break;
    text.append(buffer, static_cast<std::size_t>(got));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  std::vector<Failure> failures = parsed(text);
  if (late) {
    failures.push_back({"time", 0, fmt::format("not done after {:.0f} s", seconds)});
  } else if (WIFSIGNALED(status)) {
    failures.push_back(
        {"crash", 0, fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))});
  } else if (WEXITSTATUS(status) != 0) {
    failures.push_back({"crash", 0, fmt::format("ended with status {}", WEXITSTATUS(status))});
  }
  return failures;
}

}  // namespace fluidtex::stress
