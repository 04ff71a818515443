// Words and numbers of text files.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fluidtex::sim {

inline bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

inline bool isLineEnd(char c) {
  return c == '\n' || c == '\r';
}

// Takes the first word off the text; empty where there is none.
inline std::string_view takeWord(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && (isBlank(text[begin]) || isLineEnd(text[begin]))) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !isBlank(text[end]) && !isLineEnd(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

// Takes a line off the text, with its end: \n, \r\n or \r.
inline std::string_view takeLine(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  const bool two = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
  text.remove_prefix(std::min(text.size(), end + (two ? 2 : 1)));
  return line;
}

inline std::string inLowerCase(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

// The word in quotes and shortened, for messages; characters that cannot be printed become '?'.
inline std::string inQuotes(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (word.size() > kLongest ? "...'" : "'");
}

// Parses a word as a number. False where it is none; too large a number becomes infinite.
inline bool parseNumber(std::string_view word, double& number) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (word.empty() || end != word.data() + word.size()) return false;
  if (error == std::errc::result_out_of_range) number = std::strtod(std::string(word).c_str(), nullptr);
  return true;
}

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// Removes a byte-order mark. Throws std::runtime_error for UTF-16.
inline std::string_view withoutMark(std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw std::runtime_error("is text of two bytes a letter (UTF-16); save it as UTF-8 or ASCII");
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

}  // namespace fluidtex::sim
