// Damaged content of a file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

// A generator of which only the seed counts, on any machine.
struct Dice {
  std::uint64_t state;
  std::uint32_t operator()(std::uint32_t sides) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state >> 33) % sides);
  }
};

// One to eight bytes or pieces changed, or replaced by one of the words.
inline std::string mutated(std::string bytes, std::uint64_t seed, const std::vector<std::string>& words) {
  Dice dice{seed * 2654435761u + 1};
  for (std::uint32_t n = dice(8) + 1; n > 0 && !bytes.empty(); --n) {
    const std::size_t at = dice(static_cast<std::uint32_t>(bytes.size()));
    const std::size_t length = dice(12);
    switch (dice(6)) {
      case 0:
        bytes[at] = static_cast<char>(dice(256));
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << dice(8)));
        break;
      case 2:
        bytes.erase(at, length);
        break;
      case 3:
        bytes.insert(at, bytes.substr(dice(static_cast<std::uint32_t>(bytes.size())), length));
        break;
      case 4:
        bytes.replace(at, std::min(length, bytes.size() - at), words[dice(std::uint32_t(words.size()))]);
        break;
      default:
        if (dice(8) == 0) bytes.resize(at);
    }
  }
  return bytes;
}
