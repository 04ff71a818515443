#include "scenes/nesting.h"

#include <vector>

namespace fluidtex::scenes {
namespace {

// Where the string that begins at `at` ends: behind its closing quotes, or where it should have been closed.
std::size_t endOfString(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool escapes = quote == '"',
             many = text.substr(at).starts_with(std::string_view(quote == '"' ? "\"\"\"" : "'''"));
  at += many ? 3 : 1;
  while (at < text.size()) {
    if (escapes && text[at] == '\\') {
      at += 2;
      continue;
    }
    if (!many && text[at] == '\n') return at;
    if (text[at] == quote) {
      if (!many) return at + 1;
      std::size_t quotes = 1;
      while (at + quotes < text.size() && text[at + quotes] == quote) ++quotes;
      at += quotes;
      if (quotes >= 3) return at;
      continue;
    }
    ++at;
  }
  return text.size();
}

}  // namespace

std::optional<TextPlace> tooDeep(std::string_view text) {
  std::vector<int> outside;  // of each open bracket: how deep it lies
  int parts = 0;             // dots of the key that is being written
  TextPlace place;
  std::size_t lineStart = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char letter = text[at];
    const std::size_t from = at++;
    switch (letter) {
      case '"':
      case '\'':
        at = endOfString(text, from);
        for (std::size_t i = from; i < at && i < text.size(); ++i)
          if (text[i] == '\n') ++place.line, lineStart = i + 1;
        break;
      case '#':
        while (at < text.size() && text[at] != '\n') ++at;
        break;
      case '\n':
        ++place.line;
        lineStart = at;
        parts = 0;
        break;
      case '.':
        ++parts;
        break;
      case '[':
      case '{':
        outside.push_back((outside.empty() ? 0 : outside.back()) + parts + 1);
        parts = 0;
        break;
      case ']':
      case '}':
        if (!outside.empty()) outside.pop_back();
        parts = 0;
        break;
      case ',':
        parts = 0;
        break;
      default:
        break;
    }
    if ((outside.empty() ? 0 : outside.back()) + parts > kDeepest) {
      place.column = int(from - lineStart) + 1;
      return place;
    }
  }
  return std::nullopt;
}

}  // namespace fluidtex::scenes
