#include "tools/base/console.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace fluidtex::tools {
namespace {

int printFault = 0;                    // errno of the first failure
std::atomic<bool> statusShown{false};  // by any thread

void put(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

bool has(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

void noteFault() {
  if (printFault == 0) printFault = errno != 0 ? errno : EIO;
}

}  // namespace

void openStandardStreams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // The wrong way round, so that what is printed to a closed stdout is known to be lost.
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

void sayText(std::string_view text) {
  static const bool colors = drawsStatus() && !has("NO_COLOR");
  clearStatus();
  if (colors)
    put(colored(text));
  else
    put(text);
}

std::string colored(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> kWords[] = {{"error: ", "\033[1;31m"},
                                                                      {"warning: ", "\033[1;33m"}};
  for (const auto& [word, color] : kWords) {
    // At the beginning, or behind the place that it is about.
    const std::size_t at = text.starts_with(word) ? 0 : text.find(": " + std::string(word));
    if (at == text.npos) continue;
    const std::size_t begin = at == 0 ? 0 : at + 2, end = begin + word.size() - 2;
    return std::string(text.substr(0, begin)) + std::string(color) +
           std::string(text.substr(begin, end - begin)) + "\033[0m" + std::string(text.substr(end));
  }
  return std::string(text);
}

std::string asTyped(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || std::strchr("/._-+,:@%", c);
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

bool drawsStatus() {
  static const bool draws =
      isatty(STDERR_FILENO) == 1 && (!has("TERM") || std::getenv("TERM") != std::string("dumb"));
  return draws;
}

int statusWidth() {
  winsize size{};
  // One less: a full line would move the cursor on to the next.
  return (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80) - 1;
}

void showStatus(std::string_view line) {
  if (!drawsStatus()) return;
  put("\r\033[K");
  put(line.substr(0, std::size_t(statusWidth())));
  statusShown = true;
}

void clearStatus() {
  if (statusShown.exchange(false)) put("\r\033[K");
}

void printText(std::string_view text) {
  clearStatus();
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) noteFault();
}

void finishPrinting() {
  errno = 0;
  // What another has flushed before in vain is remembered by the stream alone.
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) noteFault();
  if (printFault == 0) return;
  const std::string why = std::strerror(printFault);
  printFault = 0;
  std::clearerr(stdout);
  throw std::runtime_error("what was to be printed could not be: " + why);
}

}  // namespace fluidtex::tools
