// The river, the pour, the drops and the flows.
#include "scenes/scene.h"

#include <catch2/catch.hpp>

#include <filesystem>

namespace fluidtex::scenes {

TEST_CASE("shipped scenes: are read in every quality, with files that are there", "[scenes]") {
  for (const std::string file :
       {"river", "river_leaves", "river_waves", "river_rocks", "river_strokes", "pour", "drops", "ripples",
        "crust", "melt", "flows/deformation", "flows/stretch", "flows/source_sink", "flows/slot",
        "flows/lock", "flows/vortex", "flows/sphere", "flows/torus"}) {
    const std::string name = file.substr(file.find('/') + 1);
    for (const Quality quality : {Quality::preview, Quality::standard, Quality::final}) {
      Overrides overrides;
      overrides.quality = quality;
      const Scene scene = loadScene(FLUIDTEX_SOURCE_DIR "/scenes/" + file + ".toml", overrides);
      CHECK(scene.name == name);
      CHECK(std::filesystem::is_regular_file(scene.texture.exemplar.file));
      for (const sim::Solid& solid : scene.sim.solids) {
        if (const auto* ground = std::get_if<sim::HeightField>(&solid.shape.kind))
          CHECK(std::filesystem::is_regular_file(ground->file));
      }
    }
  }
}

}  // namespace fluidtex::scenes
