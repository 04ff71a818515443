#include "tools/base/work.h"

#include <catch2/catch.hpp>

#include <new>
#include <string>
#include <system_error>

using namespace fluidtex::tools;
using Catch::Matchers::Contains;

TEST_CASE("work: what runs out of memory is named, with the frame and what lowers it", "[tools]") {
  nowAt(kOnTexture, 7);
  const std::string text = outOfMemory();
  CHECK_THAT(text, Contains("out of memory") && Contains(kOnTexture.what) && Contains(kOnTexture.lower) &&
                       Contains("7"));
  nowAt(kOnFiles);
  CHECK_THAT(std::string(outOfMemory()), Contains(kOnFiles.what) && !Contains("7"));
}

TEST_CASE("work: advice is for threads that cannot be started, and for nothing else", "[tools]") {
  const std::system_error noThread(std::make_error_code(std::errc::resource_unavailable_try_again));
  CHECK_FALSE(std::string(threadAdvice(noThread)).empty());
  CHECK(std::string(threadAdvice(std::runtime_error("else"))).empty());
  CHECK(std::string(threadAdvice(std::bad_alloc())).empty());
}
