// What the program prints. Its progress and its complaints are for who looks on: where they cannot be
// printed, the work goes on. What it was called for has to get there.
#pragma once

#include <fmt/core.h>

#include <string_view>
#include <utility>

namespace fluidtex::tools {

// To be called first of all. Standard streams that were closed lead nowhere from then on: the next file that
// is opened would take their place, and what is printed would go into it. No signal ends the program where a
// pipe's reader has gone or a file may not grow any more: the call that writes says so.
void openStandardStreams();

void sayText(std::string_view text);
void printText(std::string_view text);

// On stderr; never fails.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  sayText(fmt::format(format, std::forward<Args>(args)...));
}

// On stdout; whether it got there, finishPrinting() tells.
template <typename... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  printText(fmt::format(format, std::forward<Args>(args)...));
}

// Throws std::runtime_error where anything that was printed on stdout did not get there; once.
void finishPrinting();

}  // namespace fluidtex::tools
