// Exceptions of commands for user errors, and exit codes of all exceptions.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace fluidtex::tools {

enum ExitCode { kDone = 0, kInputWrong = 1, kFailed = 2, kInterrupted = 130 };

// The arguments do not fit the scene or the contents of the out folder; one sentence.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Stopped on request; what is finished is on disk. `onward`: the option with which the same command goes on.
struct Interrupted : std::runtime_error {
  explicit Interrupted(const std::string& onward = "--resume")
      : std::runtime_error("interrupted; the same command with " + onward +
                           " goes on from the last finished frame") {}
};

// Calls body. Prints an exception's sentence on stderr (for a scene one line per fault) and returns its exit
// code: invalid scenes, exemplars, meshes and arguments kInputWrong, Interrupted kInterrupted, all else
// kFailed.
int guarded(const std::function<void()>& body);

}  // namespace fluidtex::tools
