// What the targets have in common: files to read, and what a refusal must be like.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
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

}  // namespace fluidtex::fuzz
