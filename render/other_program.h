// Runs other programs, without a shell.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fluidtex::render {

struct Outcome {
  int exitCode = 0;        // or 128 + signal
  std::string output;      // all that it wrote to stdout
  std::string complaints;  // and to stderr
};

// What is done while it runs. Whatever `line` throws ends it too, and is thrown on.
struct Meanwhile {
  std::function<void(const std::string&)>
      line;                    // gets each line of its stdout as it comes; output lacks them
  std::function<bool()> stop;  // asked ten times a second; the program is killed once it says so
};

// Runs a program found on PATH with `input` on its stdin, and waits for its end. Throws std::runtime_error,
// with its name and the reason, if it cannot be started. It need not read all of its input.
Outcome runOther(const std::vector<std::string>& arguments, const std::string& input = {},
                 const Meanwhile& meanwhile = {});

// The last line with text; never empty.
std::string lastLine(const std::string& text);

}  // namespace fluidtex::render
