#include "foreign/unreadable.h"

namespace fluidtex::foreign {

std::string asClause(std::string_view words) {
  constexpr std::size_t kLongest = 300;
  std::string clause;
  for (const char letter : words.substr(0, 4 * kLongest)) {
    const bool blank = static_cast<unsigned char>(letter) <= ' ' || letter == '\x7f';
    if (!blank)
      clause += letter;
    else if (!clause.empty() && clause.back() != ' ')
      clause += ' ';
  }
  // A second sentence becomes a part of the first.
  for (std::size_t at = clause.find(". "); at != clause.npos; at = clause.find(". ", at)) clause[at] = ';';
  if (clause.size() > kLongest) {
    clause.resize(kLongest);
    // No letter of several bytes is cut in two.
    while (!clause.empty() && (static_cast<unsigned char>(clause.back()) & 0xc0) == 0x80) clause.pop_back();
    if (!clause.empty() && static_cast<unsigned char>(clause.back()) >= 0xc0) clause.pop_back();
    clause += "...";
    return clause;
  }
  while (!clause.empty() && (clause.back() == ' ' || clause.back() == '.' || clause.back() == ';'))
    clause.pop_back();
  return clause;
}

}  // namespace fluidtex::foreign
