// Console output. Progress and messages may fail to print without stopping the work; results must not get
// lost.
#pragma once

#include <fmt/core.h>

#include <string_view>
#include <utility>

namespace fluidtex::tools {

// To be called first. Opens closed standard streams to nowhere, since the next file that is opened would take
// their place and receive what is printed. Ignores the signals of broken pipes and file size limits, so that
// the write reports the error.
void openStandardStreams();

void sayText(std::string_view text);
void printText(std::string_view text);

// On stderr; never fails.
template <typename... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
  sayText(fmt::format(format, std::forward<Args>(args)...));
}

// On stdout; failures are reported by finishPrinting().
template <typename... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  printText(fmt::format(format, std::forward<Args>(args)...));
}

// Throws std::runtime_error, once, if anything printed on stdout was lost.
void finishPrinting();

}  // namespace fluidtex::tools
