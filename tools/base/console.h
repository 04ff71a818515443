// Console output. Progress and messages may fail to print without stopping the work; results must not get
// lost.
#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>
#include <utility>

namespace fluidtex::tools {

// To be called first. Opens closed standard streams to nowhere, since the next file that is opened would take
// their place and receive what is printed. Ignores the signals of broken pipes and file size limits, so that
// the write reports the error.
void openStandardStreams();

// On a terminal colored(), unless the variable NO_COLOR is set (https://no-color.org).
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

// Whether stderr is a terminal on which a line can be drawn anew: not so where TERM is "dumb".
bool drawsStatus();
// Draws a line that stays until the next one, or anything that is said or printed, takes its place; of a long
// one the beginning. Where drawsStatus() is false, nothing.
void showStatus(std::string_view line);
int statusWidth();  // the longest, letters
void clearStatus();

// A word, such as a file's name, as it can be typed into a shell: in quotes where it needs them.
std::string asTyped(const std::string& word);

// A message for a terminal: its words "error" and "warning" in colour. Only `text`, where there are none.
std::string colored(std::string_view text);

}  // namespace fluidtex::tools
