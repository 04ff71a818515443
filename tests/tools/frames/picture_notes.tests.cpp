#include "tools/frames/picture_notes.h"

#include "tests/tools/command_line/asked.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>

namespace fs = std::filesystem;
using Catch::Contains;
using namespace fluidtex;

TEST_CASE("picture notes: title, frame, time from 0 and version, and nothing of the machine", "[tools]") {
  scenes::Scene scene;
  scene.name = "dam";
  scene.file = "/home/somebody/dam.toml";
  scene.sim.frameRate = 30.0;
  const auto notesOf = [&](int frame) {
    std::vector<std::string> lines;
    for (const render::PictureNote& note : tools::pictureNotes(scene, frame))
      lines.push_back(note.key + ": " + note.text);
    return lines;
  };
  const std::string software = "Software: fluidtex " FLUIDTEX_VERSION;
  CHECK(notesOf(1) == std::vector<std::string>{"Title: dam", "Frame: 1", "Time: 0 s", software});
  CHECK(notesOf(11) == std::vector<std::string>{"Title: dam", "Frame: 11", "Time: 0.333333 s", software});
  CHECK(notesOf(3001) == std::vector<std::string>{"Title: dam", "Frame: 3001", "Time: 100 s", software});
}

TEST_CASE("command line: pictures hold scene, frame, time and version, and nothing else",
          "[tools][command_line]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", again = scratch.path / "again";
  REQUIRE(runProgram({"run", kSmallScene, "--frames", "1:3", "--set", "name=Fluß", "--out", out.string()})
              .exitCode == 0);
  CHECK_THAT(readBytes(out / "frames" / "0003.png"), !Contains(scratch.path.string()) && !Contains("tIME"));
  // Pictures of the surfaces say the same.
  REQUIRE(runProgram({"render", kSmallScene, "--from", out.string(), "--frames", "1:3", "--set", "name=Fluß",
                      "--out", again.string()})
              .exitCode == 0);
  for (const fs::path& folder : {out, again}) {
    const auto input = OIIO::ImageInput::open((folder / "frames" / "0003.png").string());
    REQUIRE(input);
    CHECK(input->spec().get_string_attribute("DocumentName") == "Fluß");
    CHECK(input->spec().get_string_attribute("Frame") == "3");
    CHECK(input->spec().get_string_attribute("Time") == "0.0833333 s");
    CHECK("fluidtex " FLUIDTEX_VERSION == std::string(input->spec().get_string_attribute("Software")));
  }
}
