// The report of a finished run, in a folder that has its exemplar and a surface.
#include "tests/fuzz/reader.h"
#include "tools/run_folder/finished_run.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto exemplar = [] {
    const std::string picture = "P5\n8 8\n255\n" + std::string(64, 'x');
    std::filesystem::create_directories(fuzz::folder() / "surface");
    fuzz::written("surface/0001.ply", nullptr, 0);
    return fuzz::written("e.pgm", reinterpret_cast<const std::uint8_t*>(picture.data()), picture.size());
  }();
  fuzz::written("run.json", data, size);
  return fuzz::outcomeOf<std::runtime_error>([&] {
    const tools::FinishedRun run = tools::openRun(fuzz::folder(), exemplar);
    texture::TexturedSurface square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    square.triangles = {{0, 1, 2}};
    tools::spacingOf(run, square, 1);
  });
}
