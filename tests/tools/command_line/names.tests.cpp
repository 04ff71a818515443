// Files and folders with names that mean something to a shell, a web page or printf.
#include "tests/tools/command_line/asked.h"

#include <fstream>

namespace fs = std::filesystem;

TEST_CASE("command line: odd names of files and folders", "[tools][command_line]") {
  const Scratch scratch;
  const fs::path folder = scratch.path / "Öl & Wasser 100 % 'neu' #1 $HOME";
  fs::create_directories(folder);
  const fs::path scene = folder / "große Welle %d.toml", picture = folder / "Bild 50% [1] {2}.png";
  fs::copy_file(FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png", picture);
  std::string text = readBytes(kSmallScene);
  const std::string shipped = "../../scenes/exemplars/green_scales.png";
  text.replace(text.find(shipped), shipped.size(), picture.filename().string());
  std::ofstream(scene) << text;
  const auto runs = [&](std::vector<std::string> args) {
    const Finished run = runProgram(args, folder);
    INFO(args[0] << ": " << run.all());
    CHECK(run.exitCode == 0);
    return run;
  };
  const std::string out = "Ergebnis & mehr %04d", name = scene.filename().string();
  runs({"check", name});
  runs({"run", name, "--frames", "1:2", "--out", out});
  CHECK(fs::exists(folder / out / "große Welle %d.mp4"));
  runs({"render", name, "--from", out, "--frames", "1:2", "--out", "noch einmal"});
  CHECK(fs::exists(folder / "noch einmal" / "große Welle %d.mp4"));
  runs({"apply", out, "height=" + picture.filename().string()});
  // The liquid of another program, here meshes in numbered files.
  fs::create_directories(folder / "Flüssigkeit & 1 %");
  for (const char* number : {"1", "2", "3"})
    fs::copy_file(folder / out / "surface" / "0001.ply",
                  folder / "Flüssigkeit & 1 %" / ("Netz " + std::string(number) + ".ply"));
  runs({"check", "Flüssigkeit & 1 %"});
  runs({"texture", "Flüssigkeit & 1 %/Netz #.ply", "--exemplar", picture.filename().string(), "--set",
        "texture.points=1000", "--set", "files.least_explained=0", "--frames", "1:2", "--out", "Netze"});
  CHECK(fs::exists(folder / "Netze" / "Netz.mp4"));
  // Cut or cleaned of what only that name means to another program, nothing was written beside it.
  for (const auto& entry : fs::directory_iterator(scratch.path)) CHECK(entry.path() == folder);
}
