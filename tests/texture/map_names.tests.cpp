#include "texture/map_names.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

TEST_CASE("map names: those of a vertex's own properties are reserved, others are not", "[texture]") {
  for (const char* name : {"x", "nz", "red", "alpha", "s", "fade_t", "foam", "guidance"})
    CHECK(isReservedName(name));
  for (const char* name : {"roughness", "height", "X", "", "fade_x"}) CHECK_FALSE(isReservedName(name));
  CHECK(vectorNames("normal") == std::vector<std::string>{"normal_x", "normal_y", "normal_z"});
}
