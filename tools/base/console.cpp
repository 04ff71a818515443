#include "tools/base/console.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace fluidtex::tools {
namespace {

int printFault = 0;  // errno of the first failure

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
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void printText(std::string_view text) {
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
