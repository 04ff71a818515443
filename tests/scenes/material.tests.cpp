// What the liquid is made of, told wrong.
#include "tests/scenes/fault_cases.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("scene faults: what a material cannot be", "[scenes]") {
  checkCases({
      {"[render.material]\nabsorption = [1, 1, 1]",
       "s.toml:7:1: error: render.material.absorption: is of no use to a coated liquid; give kind = "
       "\"water\" too, or leave it out"},
      {"[render.material]\nheat = 'hot'",
       "s.toml:7:1: error: render.material.heat: is of no use to a coated liquid; give kind = \"lava\" too, "
       "or leave it out"},
      {"[[texture.map]]\nname = 'heat'\nfile = 'e.png'\n[render.material]\nkind = 'lava'\nheat = 'heath'",
       "s.toml:11:1: error: render.material.heat: \"heath\" is no map of this scene; did you mean \"heat\"?"},
      {"[[texture.map]]\nname = 'a'\nfile = 'e.png'\nholds = 'normals'\n[render.material]\nkind = "
       "'lava'\nheat = 'a'",
       "s.toml:12:1: error: render.material.heat: \"a\" holds vectors, which tell no heat; give a map of "
       "values"},
      {"[render.material]\nkind = 'lava'\nhottest = 500",
       "s.toml:8:1: error: render.material.hottest: the hottest, 500 K, is not above the coldest, 800 K; "
       "give "
       "hottest a larger number"},
  });
}

}  // namespace fluidtex::scenes
