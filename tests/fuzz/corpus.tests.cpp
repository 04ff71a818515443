// The fuzz targets without a fuzzer: each takes the files that its fuzzing begins with, whole and cut short.
// So a target that no longer compiles, and a reader that no longer ends as it must, are seen without clang.
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

// LLVMFuzzerTestOneInput of each target, by the name that CMakeLists.txt gives it here.
#define FLUIDTEX_TARGET(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size)
FLUIDTEX_TARGET(geometry);
FLUIDTEX_TARGET(heights);
FLUIDTEX_TARGET(image);
FLUIDTEX_TARGET(mesh);
FLUIDTEX_TARGET(ply);
FLUIDTEX_TARGET(profile);
FLUIDTEX_TARGET(run);
FLUIDTEX_TARGET(scene);
FLUIDTEX_TARGET(set);
FLUIDTEX_TARGET(state);
FLUIDTEX_TARGET(vdb);
#undef FLUIDTEX_TARGET

namespace {

struct Target {
  const char* name;
  int (*takes)(const std::uint8_t*, std::size_t);
};

const Target kTargets[] = {{"geometry", fuzz_geometry}, {"heights", fuzz_heights}, {"image", fuzz_image},
                           {"mesh", fuzz_mesh},         {"ply", fuzz_ply},         {"profile", fuzz_profile},
                           {"run", fuzz_run},           {"scene", fuzz_scene},     {"set", fuzz_set},
                           {"state", fuzz_state},       {"vdb", fuzz_vdb}};

}  // namespace

TEST_CASE("fuzz targets: what fuzzing begins with, whole and cut short, is read or refused in a sentence",
          "[fuzz]") {
  const std::filesystem::path corpora = FLUIDTEX_SOURCE "/tests/fuzz/corpus";
  const Scratch scratch;
  const std::string own = scratch.path.string();
  REQUIRE(setenv("TMPDIR", own.c_str(), 1) == 0);  // where the targets write what they read
  for (const Target& target : kTargets) {
    const std::vector<std::string> files = filesIn(corpora / target.name);
    REQUIRE_FALSE(files.empty());
    for (const std::string& file : files) {
      const std::string bytes = readBytes(corpora / target.name / file);
      for (const std::size_t size : {bytes.size(), bytes.size() / 2, std::size_t{0}}) {
        INFO(target.name << ": " << file << ", " << size << " bytes");
        CHECK(target.takes(reinterpret_cast<const std::uint8_t*>(bytes.data()), size) == 0);
      }
    }
  }
}
