// Sequences of pictures as exemplars: what is read, and what is wrong with them.
#include "scenes/checks.h"

#include "tests/scenes/fault_cases.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("scene faults: exemplars that move", "[scenes]") {
  const std::string rest = kGoodScene.substr(kGoodScene.find('\n'));  // lines 2 to 5
  const std::string moving = "texture.exemplar = 't_%d.obj'" + rest;
  CHECK(faultsOf(moving).empty());
  checkWholeFiles({
      {"texture.exemplar = 'nothing_%d.png'" + rest,
       "s.toml:1:9: error: texture.exemplar: no such file: nothing_%d.png; give the pattern of two pictures "
       "or more, or the name of one"},
      {"texture.exemplar = 't_%04d.obj'" + rest,
       "s.toml:1:9: error: texture.exemplar: no such file: t_%04d.obj; give the pattern of two pictures or "
       "more, or the name of one"},
      {"texture.exemplar = '%_%d.png'" + rest,
       "s.toml:1:9: error: texture.exemplar: %_%d.png does not say in one place where the number is; write "
       "%d "
       "for it, or %04d where it has four digits, for example \"rock_%04d.png\""},
      {"texture.animation.by = 'guidance'\n" + moving,
       "s.toml:1:19: error: texture.animation.by: there is no guidance to choose the picture; give "
       "[texture.guidance] with by and [[texture.guidance.point]], or by = \"time\""},
      {"texture.animation.by = 'guidance'\n"
       "texture.guidance = { by = 'height', map = 'e.png', point = [{ value = 0, level = 1 }] }\n" +
           moving,
       "s.toml:2:37: error: texture.guidance.map: is of no use: guidance chooses pictures of the sequence, "
       "not places in them; leave it out, or give texture.animation.by = \"time\""},
      {"texture.between = 'file'\ntexture.between_file = 'e.png'\n" + moving,
       "s.toml:1:9: error: texture.between: \"file\" is one picture, and the exemplar a sequence; give "
       "\"points\" or \"exemplar\""},
      {"texture.between = 'exemplar'\ntexture.animation.by = 'guidance'\n"
       "texture.guidance = { by = 'height', point = [{ value = 0, level = 1 }] }\n" +
           moving,
       "s.toml:1:9: error: texture.between: \"exemplar\" is one picture for all places, and by = "
       "\"guidance\" "
       "shows many; give \"points\""},
      {kGoodScene + "[texture.animation]\nrate = 6",
       "s.toml:6:10: error: texture.animation: the exemplar is one picture; give a sequence of them, for "
       "example exemplar = \"lava_%04d.png\""},
  });
  // Where colours are carried, or there are none, the first picture stays.
  for (const char* carried : {"method = 'none'", "method = 'kwatra07'", "later_frames = 'advect'"})
    CHECK(faultsOf("texture." + std::string(carried) + "\n" + moving).empty());
  // Another picture on the command line needs no other scene.
  CHECK(faultsOf("texture.animation.rate = 6\n" + moving, {.exemplar = "/dev/null"}).empty());
}

}  // namespace fluidtex::scenes
