// What is wrong with a file of others.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace fluidtex::foreign {

// The file cannot be read or used; the message is the end of a sentence that begins with the file's name,
// without its full stop.
struct Unreadable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A library's own words as a part of one sentence: one line, no full stop, at most 300 letters.
std::string asClause(std::string_view words);

}  // namespace fluidtex::foreign
