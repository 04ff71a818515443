// A cache of another program: a ball that moves, and how it is textured.
#pragma once

#include "tests/tools/program.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

inline constexpr const char* kScales = FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png";

// A ball of radius 0.2 m that moves by `speed` m/s along x at 24 frames a second, with `written` as its
// velocity, and an attribute `heat` from 300 at its lowest point to 500.
inline void writeBalls(const std::filesystem::path& folder, int frames, double speed, double written) {
  constexpr int kRings = 24, kAround = 48;
  for (int frame = 1; frame <= frames; ++frame) {
    std::string text, faces;
    int count = 0;
    for (int ring = 0; ring <= kRings; ++ring)
      for (int n = 0; n < kAround; ++n) {
        const double theta = std::numbers::pi * ring / kRings, phi = 2.0 * std::numbers::pi * n / kAround;
        text += std::to_string(0.2 * std::sin(theta) * std::cos(phi) + speed * (frame - 1) / 24.0) + " " +
                std::to_string(0.2 * std::sin(theta) * std::sin(phi)) + " " +
                std::to_string(0.2 * std::cos(theta)) + " " + std::to_string(written) + " 0 0 " +
                std::to_string(400.0 + 100.0 * std::cos(theta)) + "\n";
        if (ring == kRings) continue;
        const int here = ring * kAround, next = here + kAround, after = (n + 1) % kAround;
        faces += "4 " + std::to_string(here + n) + " " + std::to_string(next + n) + " " +
                 std::to_string(next + after) + " " + std::to_string(here + after) + "\n";
        ++count;
      }
    char name[32];
    std::snprintf(name, sizeof name, "ball_%04d.ply", frame);
    std::ofstream(folder / name)
        << "ply\nformat ascii 1.0\nelement vertex " << (kRings + 1) * kAround
        << "\nproperty float x\nproperty float y\nproperty float z\nproperty float vx\nproperty float vy\n"
           "property float vz\nproperty float heat\nelement face "
        << count << "\nproperty list uchar int vertex_indices\nend_header\n"
        << text << faces;
  }
}

inline std::vector<std::string> texturing(const std::filesystem::path& cache,
                                          const std::filesystem::path& out) {
  return {"texture",
          cache.string(),
          "--exemplar",
          kScales,
          "--out",
          out.string(),
          "--no-render",
          "--set",
          "texture.points=1500",
          "--set",
          "texture.first_iterations=[1, 1, 1]"};
}

// Without a fault.
inline Finished textured(const std::filesystem::path& cache, const std::filesystem::path& out) {
  const Finished done = runProgram(texturing(cache, out));
  INFO(done.all());
  REQUIRE(done.exitCode == 0);
  return done;
}
