// make_exemplars FOLDER [WIDTH]: writes the example images that ship with the scenes into FOLDER; with a
// WIDTH the green scales alone, green_scales_WIDTH.png: the same picture, so many pixels wide.
#include "scenes/exemplars/foam.h"
#include "scenes/exemplars/lava.h"
#include "scenes/exemplars/leaves.h"
#include "scenes/exemplars/ripples.h"
#include "scenes/exemplars/scales.h"
#include "scenes/exemplars/stones.h"
#include "scenes/exemplars/strokes.h"
#include "scenes/exemplars/waves.h"
#include "scenes/write_png.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>

namespace {

// Three bytes a pixel are sRGB, a fourth is alpha; one is a number. numbers: three are numbers too.
bool write(const std::string& file, int size, const std::vector<std::uint8_t>& pixels, bool numbers = false) {
  const int channels = int(pixels.size()) / (size * size);
  OIIO::ImageSpec spec(size, size, channels, OIIO::TypeDesc::UINT8);
  if (channels == 4) {
    spec.alpha_channel = 3;
    spec.attribute("oiio:UnassociatedAlpha", 1);
  }
  if (channels >= 3 && !numbers) spec.attribute("oiio:ColorSpace", "sRGB");
  if (!fluidtex::scenes::writePng(file, spec, pixels.data())) return false;
  std::cout << file << "\n";
  return true;
}

// FOLDER/0000.png and so on.
bool writeSequence(const std::filesystem::path& folder, int pictures, int size,
                   const std::function<std::vector<std::uint8_t>(int)>& pixels) {
  std::filesystem::create_directories(folder);
  for (int n = 0; n < pictures; ++n) {
    char name[32];
    std::snprintf(name, sizeof name, "%04d.png", n);
    if (!write((folder / name).string(), size, pixels(n))) return false;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc == 3 ? std::atoi(argv[2]) : 0;
  if (argc < 2 || argc > 3 || (argc == 3 && (width < 1 || width > 8192)) ||
      !std::filesystem::is_directory(argv[1])) {
    std::cerr << "usage: make_exemplars FOLDER [WIDTH], for example make_exemplars scenes/exemplars\n";
    return 1;
  }
  const std::filesystem::path folder = argv[1];
  fluidtex::exemplars::Scales scales;
  if (width > 0) {
    scales.size = width;
    const std::string name = "green_scales_" + std::to_string(width) + ".png";
    return write((folder / name).string(), width, fluidtex::exemplars::makeGreenScales(scales)) ? 0 : 2;
  }
  const fluidtex::exemplars::Lava lava;
  const fluidtex::exemplars::CoolingLava cooling = fluidtex::exemplars::makeCoolingLava();
  const fluidtex::exemplars::FoamyWater water;
  const fluidtex::exemplars::FoamImages foam = fluidtex::exemplars::makeFoam(water);
  const fluidtex::exemplars::Ripples ripples;
  const fluidtex::exemplars::Leaves leaves;
  const fluidtex::exemplars::Stones bed;
  const fluidtex::exemplars::StoneImages stones = fluidtex::exemplars::makeStones(bed);
  const fluidtex::exemplars::Strokes strokes;
  const fluidtex::exemplars::Waves sea;
  const fluidtex::exemplars::WaveImages waves = fluidtex::exemplars::makeWaves(sea);
  constexpr int kStages = 12;
  const int coolingSize = fluidtex::exemplars::kCooling.size;
  const bool written =
      write((folder / "green_scales.png").string(), scales.size,
            fluidtex::exemplars::makeGreenScales(scales)) &&
      write((folder / "green_scales_height.png").string(), scales.size,
            fluidtex::exemplars::makeScalesHeight(scales)) &&
      write((folder / "lava.png").string(), lava.size, fluidtex::exemplars::makeLava(lava)) &&
      write((folder / "lava_cooling.png").string(), coolingSize, cooling.pixels) &&
      write((folder / "lava_cooling_guidance.png").string(), coolingSize, cooling.guidance) &&
      write((folder / "leaves.png").string(), leaves.size, fluidtex::exemplars::makeLeaves(leaves)) &&
      write((folder / "stones.png").string(), bed.size, stones.pixels) &&
      write((folder / "stones_height.png").string(), bed.size, stones.height) &&
      write((folder / "strokes.png").string(), strokes.size, fluidtex::exemplars::makeStrokes(strokes)) &&
      write((folder / "waves.png").string(), sea.size, waves.pixels) &&
      write((folder / "waves_normals.png").string(), sea.size, waves.normals, true) &&
      write((folder / "foam.png").string(), water.size, foam.pixels) &&
      write((folder / "foam_guidance.png").string(), water.size, foam.guidance) &&
      writeSequence(folder / "lava_stages", kStages, fluidtex::exemplars::kLavaStages.size,
                    [](int n) { return fluidtex::exemplars::makeLavaAtStage(double(n) / (kStages - 1)); }) &&
      writeSequence(folder / "ripples", ripples.pictures, ripples.size,
                    [&](int n) { return fluidtex::exemplars::makeRipples(ripples, n); });
  return written ? 0 : 2;
}
