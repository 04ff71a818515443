// Other programs, run without a shell.
#pragma once

#include <string>
#include <vector>

namespace fluidtex::render {

struct Outcome {
  int exitCode = 0;        // or 128 + signal
  std::string output;      // all that it wrote to stdout
  std::string complaints;  // and to stderr
};

// Runs a program found on PATH, which reads `input`, and waits for its end. Throws std::runtime_error, with
// the program's name and the reason, where it cannot be started. A program that ends without having read all
// is no fault.
Outcome runOther(const std::vector<std::string>& arguments, const std::string& input = {});

// The last line that says anything; never empty.
std::string lastLine(const std::string& text);

}  // namespace fluidtex::render
