// What a command throws where the user has to act, and how every exception becomes an exit code.
#pragma once

#include <functional>
#include <stdexcept>

namespace fluidtex::tools {

enum ExitCode { kDone = 0, kInputWrong = 1, kFailed = 2, kInterrupted = 130 };

// The user's wishes do not fit the scene or what lies in the out folder; one sentence.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Stopped on request; the state of the last whole frame is on disk.
struct Interrupted : std::runtime_error {
  Interrupted()
      : std::runtime_error(
            "interrupted; the same command with --resume goes on from the last finished frame") {}
};

// Calls body; every exception becomes its sentence on stderr (all the faults of a scene, a line each) and an
// exit code: wrong scenes, exemplars, meshes and wishes kInputWrong, Interrupted kInterrupted, all else
// kFailed.
int guarded(const std::function<void()>& body);

}  // namespace fluidtex::tools
