#include "tools/base/work.h"

#include "tools/base/errors.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

namespace fluidtex::tools {
namespace {

std::atomic<const Work*> current{&kOnFiles};
std::atomic<int> currentFrame{0};

// Straight to the descriptor: streams may want memory.
void put(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void tell() noexcept {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    put("error: the program could not go on");
  } catch (const std::bad_alloc&) {
    put("error: ");
    put(outOfMemory());
  } catch (const std::exception& error) {
    put("error: ");
    put(error.what());
    put(threadAdvice(error));
  } catch (...) {
    put("error: the program could not go on");
  }
  put("\n");
}

}  // namespace

void nowAt(const Work& work, int frame) {
  current = &work;
  currentFrame = frame;
}

const char* outOfMemory() {
  static char text[400];
  const Work& work = *current;
  const int frame = currentFrame;
  char place[40] = "";
  if (frame > 0) std::snprintf(place, sizeof place, " in frame %d", frame);
  std::snprintf(text, sizeof text, "out of memory%s, at %s; lower %s, or let the program have more", place,
                work.what, work.lower);
  return text;
}

const char* threadAdvice(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  const bool refused = system != nullptr && system->code() == std::errc::resource_unavailable_try_again;
  if (!refused && std::strstr(error.what(), "pthread_create") == nullptr) return "";
  return "; a thread could not be started: give fewer with --threads, or let the program have more of them "
         "and more "
         "memory (ulimit -u, ulimit -v)";
}

void endWithSentence() {
  std::set_terminate([] {
    // Only the first thread that comes here.
    static std::atomic_flag told;
    if (!told.test_and_set()) {
      tell();
      _exit(kFailed);
    }
    for (;;) pause();
  });
}

}  // namespace fluidtex::tools
