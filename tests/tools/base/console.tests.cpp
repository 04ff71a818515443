#include "tools/base/console.h"

#include "render/other_program.h"

#include <catch2/catch.hpp>

using namespace fluidtex::tools;

TEST_CASE("console: a word as it is typed is read back by a shell", "[tools]") {
  CHECK(asTyped("out/dam_break-2.toml") == "out/dam_break-2.toml");
  for (const char* word : {"a b", "it's", "", "$HOME", "a&b;c", "50%", "Föhn*", "\"x\"", "~", "#1", "a\\b"}) {
    INFO(word);
    CHECK(fluidtex::render::runOther({"sh", "-c", "printf %s " + asTyped(word)}).output == word);
  }
}

TEST_CASE("console: the words that matter are coloured, once, and the text stays", "[tools]") {
  CHECK(colored("error: x\n") == "\033[1;31merror\033[0m: x\n");
  CHECK(colored("warning: x\n") == "\033[1;33mwarning\033[0m: x\n");
  CHECK(colored("s.toml:3:1: error: a.b: wrong\n") == "s.toml:3:1: \033[1;31merror\033[0m: a.b: wrong\n");
  for (const char* plain : {"done: out/x\n", "frame 1/3: 2 substeps\n", "", "my error: is a name\n"})
    CHECK(colored(plain) == plain);
}
