#include "tools/base/stop_signal.h"

#include "tools/base/errors.h"

#include <time.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <system_error>

namespace fluidtex::tools {
namespace {

std::atomic<bool> stopRequested{false};
timer_t patience;
char sentence[256];

// Only what a signal handler may call, here and below.
void endNow(int) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, sentence, std::strlen(sentence));
  _exit(kInterrupted);
}

void onInterrupt(int) {
  stopRequested = true;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  constexpr itimerspec kHalfSecond{{0, 0}, {0, 500'000'000}};
  timer_settime(patience, 0, &kHalfSecond, nullptr);
}

}  // namespace

const std::atomic<bool>& stopOnSignals(const std::string& onward) {
  static const bool prepared = [&] {
    std::strncpy(sentence, Interrupted(onward).what(), sizeof sentence - 2);
    std::strcat(sentence, "\n");
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGALRM;
    if (timer_create(CLOCK_MONOTONIC, &event, &patience) != 0)
      throw std::system_error(errno, std::generic_category(), "timer_create");
    std::signal(SIGALRM, endNow);
    return true;
  }();
  (void)prepared;
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  return stopRequested;
}

}  // namespace fluidtex::tools
