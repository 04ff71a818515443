// Runs other programs, without a shell.
#pragma once

#include <string>
#include <vector>

namespace fluidtex::render {

struct Outcome {
  int exitCode = 0;        // or 128 + signal
  std::string output;      // all that it wrote to stdout
  std::string complaints;  // and to stderr
};

// Runs a program found on PATH with `input` on its stdin, and waits for its end. Throws std::runtime_error,
// with its name and the reason, if it cannot be started. It need not read all of its input.
Outcome runOther(const std::vector<std::string>& arguments, const std::string& input = {});

// The last line with text; never empty.
std::string lastLine(const std::string& text);

}  // namespace fluidtex::render
