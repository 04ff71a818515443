// Text for a stream, formatted in pieces: a frame's text can be larger than all else in memory.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <string_view>
#include <utility>

namespace fluidtex::tools {

class TextStream {
 public:
  explicit TextStream(std::ostream& out) : m_out(out) {}
  ~TextStream() { flush(); }
  TextStream(const TextStream&) = delete;
  TextStream& operator=(const TextStream&) = delete;

  template <typename... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(m_text), format, std::forward<Args>(args)...);
    if (m_text.size() >= kPiece) flush();
  }
  void add(std::string_view text) { m_text.append(text); }

 private:
  static constexpr std::size_t kPiece = std::size_t{1} << 16;

  void flush() {
    m_out.write(m_text.data(), static_cast<std::streamsize>(m_text.size()));
    m_text.clear();
  }

  std::ostream& m_out;
  fmt::memory_buffer m_text;
};

}  // namespace fluidtex::tools
