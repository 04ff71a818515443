// What the targets have in common: files to read, and what a refusal must be like.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace fluidtex::fuzz {

// In a folder of this process; tools/fuzz takes it away, since libFuzzer ends without a word.
inline std::filesystem::path folder() {
  static const std::filesystem::path path = [] {
    const auto made =
        std::filesystem::temp_directory_path() / ("fluidtex_fuzz_" + std::to_string(::getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  return path;
}

inline std::filesystem::path written(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = folder() / name;
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
  return file;
}

// A line that can be read.
inline void checkSentence(const std::string& words) {
  constexpr std::size_t kLongest = 6000;
  const bool fine = !words.empty() && words.size() < kLongest && words.find('\n') == words.npos &&
                    words.find('\0') == words.npos;
  if (fine) return;
  std::fprintf(stderr, "no sentence of a line: %.2000s\n", words.c_str());
  std::abort();
}

// libFuzzer sees nothing of the code that an input reaches in fluidtex_reader. What comes back from there
// tells something of it: other words are another place. Numbers in them are not.
[[gnu::section("__libfuzzer_extra_counters")]] inline static std::uint8_t outcomes[1 << 13];

inline void cameBack(const std::string& words) {
  std::uint32_t hash = 2166136261u;  // Fowler, Noll and Vo
  for (const char letter : words)
    if (letter < '0' || letter > '9') hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
  outcomes[hash % std::size(outcomes)] = 1;
}

// Reads: any outcome is right but an exception that is no Refusal.
template <class Refusal, class Read>
int outcomeOf(const Read& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    checkSentence(refusal.what());
  }
  return 0;
}

// The same for what fluidtex_reader reads: `read` gives words for what has come back.
template <class Refusal, class Read>
int outcomeFromAfar(const Read& read) {
  return outcomeOf<Refusal>([&] {
    try {
      cameBack(read());
    } catch (const Refusal& refusal) {
      cameBack(refusal.what());
      throw;
    }
  });
}

// So that the size of a number is told in few ways.
inline std::string magnitude(double number) {
  return std::string(std::size_t(std::ilogb(std::abs(number) + 1.0)), '+') + ' ';
}

}  // namespace fluidtex::fuzz
