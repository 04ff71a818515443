// What ffprobe says of a video.
#pragma once

#include <catch2/catch.hpp>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

// `entries` of its stream, with commas between them.
inline std::string probe(const std::filesystem::path& video, const std::string& entries) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v -of csv=p=0 -show_entries stream=" + entries + " '" +
      video.string() + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  std::array<char, 256> line{};
  REQUIRE(pipe);
  REQUIRE(std::fgets(line.data(), line.size(), pipe.get()));
  std::string text = line.data();
  while (!text.empty() && (text.back() == '\n' || text.back() == ',')) text.pop_back();
  return text;
}
