// What the program says of itself, and what other programs say of what it wrote.
#pragma once

#include "render/other_program.h"
#include "tests/tools/program.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

inline int linesOf(const std::string& text) {
  return int(std::count(text.begin(), text.end(), '\n'));
}

// What the first group of `pattern` is, wherever it is found in `text`.
inline std::vector<std::string> allOf(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

// As --help lists them: two spaces, the name, more spaces.
inline std::vector<std::string> commands() {
  return allOf(runProgram({"--help"}).out, "\n  ([a-z]+) +[A-Z]");
}

inline std::vector<std::string> longOptionsOf(const std::string& command) {
  return allOf(runProgram({command, "--help"}).out, "\n  (?:-[a-zA-Z],)?(--[a-z-]+)");
}

inline bool installed(const std::string& program) {
  return fluidtex::render::runOther({"sh", "-c", "command -v " + program}).exitCode == 0;
}

// The output of another program, which ends well and without complaints.
inline std::string said(const std::vector<std::string>& arguments) {
  const fluidtex::render::Outcome outcome = fluidtex::render::runOther(arguments);
  INFO(outcome.complaints);
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.complaints.empty());
  return outcome.output;
}
