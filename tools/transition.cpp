// fluidtex transition IMAGE IMAGE...: several exemplars as one, with transitions between them and a guidance
// map.
#include "texture/exemplar/read_image.h"
#include "texture/transition/join_exemplars.h"
#include "tools/apply.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/formats/exemplar_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

struct TransitionWishes {
  std::vector<std::string> pictures;
  std::vector<std::string> maps;  // NAME=FILE, each name once for each picture, in their order
  fs::path out;
  int width = 160, feature = 24, seed = 1;
};

// A map over every picture: what it is, and its files and images in the order of the pictures.
struct MapOfEach {
  std::string name;
  texture::MapHolds holds;
  std::vector<fs::path> files;
  std::vector<texture::Image> images;
};

constexpr const char* kGuidance = "guidance";

std::vector<MapOfEach> readMaps(const TransitionWishes& wishes, const std::vector<texture::Image>& pictures) {
  std::vector<MapOfEach> maps;
  for (const std::string& text : wishes.maps) {
    const texture::MapOptions map = parseMap(text);
    auto of = std::find_if(maps.begin(), maps.end(), [&](const MapOfEach& m) { return m.name == map.name; });
    if (of == maps.end()) {
      checkMapName(map.name);
      if (map.name == kGuidance)
        throw UsageError(text + ": guidance is the map that tells the exemplars apart; give another name");
      of = maps.insert(maps.end(), MapOfEach{map.name, map.holds, {}, {}});
    }
    if (of->holds != map.holds)
      throw UsageError(text + ": holds something else than the earlier map of its name; give all alike");
    const std::size_t number = of->images.size();
    if (number >= pictures.size())
      throw UsageError(
          fmt::format("{}: is one map of this name more than there are pictures, {}", text, pictures.size()));
    texture::Image image = texture::readMap(map.file);
    if (image.width != pictures[number].width || image.height != pictures[number].height)
      throw UsageError(
          fmt::format("{}: has {} x {} pixels, and its picture, {}, {} x {}; give one of its size",
                      map.file.string(), image.width, image.height, wishes.pictures[number],
                      pictures[number].width, pictures[number].height));
    of->files.push_back(map.file);
    of->images.push_back(std::move(image));
  }
  for (const MapOfEach& map : maps) {
    if (map.images.size() < pictures.size())
      throw UsageError(
          fmt::format("--map {}=...: is given for {} of {} pictures; give one for each, in their order",
                      map.name, map.images.size(), pictures.size()));
    for (const texture::Image& image : map.images)
      if (image.channels != map.images[0].channels)
        throw UsageError(
            fmt::format("--map {}=...: some are grey and some coloured; give all alike", map.name));
  }
  return maps;
}

void checkSizes(const TransitionWishes& wishes, const std::vector<texture::Image>& pictures) {
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const int needed = (k == 0 || k + 1 == pictures.size() ? 1 : 2) * wishes.width;
    if (pictures[k].width < needed)
      throw UsageError(
          fmt::format("{}: is {} pixels wide, and its part of the transitions alone {}; give a larger "
                      "picture or a smaller --width",
                      wishes.pictures[k], pictures[k].width, needed));
  }
}

fs::path besides(const fs::path& out, const std::string& name) {
  return out.parent_path() / (out.stem().string() + "_" + name + ".png");
}

// Nothing may be written over a picture that is read.
void checkOutputs(const TransitionWishes& wishes, const std::vector<MapOfEach>& maps) {
  std::vector<fs::path> read(wishes.pictures.begin(), wishes.pictures.end());
  std::vector<fs::path> written{wishes.out, besides(wishes.out, kGuidance)};
  for (const MapOfEach& map : maps) {
    read.insert(read.end(), map.files.begin(), map.files.end());
    written.push_back(besides(wishes.out, map.name));
  }
  for (const fs::path& output : written)
    for (const fs::path& input : read)
      if (std::error_code failed; fs::equivalent(output, input, failed))
        throw UsageError(output.string() + ": is one of the pictures to join; give another --out");
}

void makeTransition(const TransitionWishes& wishes) {
  if (wishes.pictures.size() < 2)
    throw UsageError(wishes.pictures[0] + ": is one picture; give two or more, in the order of their levels");
  std::vector<texture::Image> pictures;
  for (const std::string& file : wishes.pictures) pictures.push_back(texture::readImage(file));
  checkSizes(wishes, pictures);
  const std::vector<MapOfEach> maps = readMaps(wishes, pictures);
  checkOutputs(wishes, maps);
  const texture::JoinedExemplars joined = texture::joinExemplars(
      pictures, {.width = wishes.width, .feature = wishes.feature, .seed = std::uint64_t(wishes.seed)});
  const auto put = [](const fs::path& file, const std::string& bytes) {
    writeAtomically(file, [&](const fs::path& temporary) { writeBytes(temporary, bytes); });
  };
  const fs::path guidance = besides(wishes.out, kGuidance);
  for (const MapOfEach& map : maps)
    put(besides(wishes.out, map.name), pngOfNumbers(joinedMap(joined, map.images)));
  put(guidance, pngOfNumbers(joined.guidance));
  put(wishes.out, pngOf(texture::joinedMap(joined, pictures)));
  print(
      "{}: {} x {} pixels; in a scene:\n\n[texture]\nexemplar = \"{}\"\n\n[texture.guidance]\nby = "
      "\"mixture\"\n"
      "map = \"{}\"\npoint = [{{ value = 0.0, level = 0.0 }}, {{ value = 1.0, level = 1.0 }}]\n",
      wishes.out.string(), joined.width, joined.height, wishes.out.string(), guidance.string());
  for (const MapOfEach& map : maps) {
    print("\n[[texture.map]]\nname = \"{}\"\nfile = \"{}\"\n", map.name,
          besides(wishes.out, map.name).string());
    if (map.holds != texture::MapHolds::values)
      print("holds = \"{}\"\n", map.holds == texture::MapHolds::normals ? "normals" : "directions");
  }
}

}  // namespace

Command transitionCommand() {
  const auto wishes = std::make_shared<TransitionWishes>();
  Command command{"transition", "Make one exemplar of several, with transitions that guidance chooses from"};
  command.options = {
      {"images",
       &wishes->pictures,
       "IMAGE",
       "Two or more, in the order of their levels, 0 to 1",
       {.required = true}},
      {"--out",
       &wishes->out,
       "IMAGE.png",
       "The exemplar; its guidance map is IMAGE_guidance.png beside it",
       {.required = true, .ending = ".png"}},
      {"--map", &wishes->maps, "NAME=FILE",
       "A map over one of the images, of its size: once for each, in their order; joined as they are, "
       "IMAGE_NAME.png"},
      {"--width",
       &wishes->width,
       "PIXELS",
       "Width of a transition (default 160)",
       {.least = 8, .most = 4096}},
      {"--feature",
       &wishes->feature,
       "PIXELS",
       "Diameter of the smallest pieces, about that of a scale or stone (default 24)",
       {.least = 2, .most = 1024}},
      {"--seed", &wishes->seed, "N", "Another one gives other pieces (default 1)", {.least = 0}},
  };
  command.footer = "Example:\n  fluidtex transition water.png lava.png --out both.png --width 200";
  command.run = [wishes] {
    makeTransition(*wishes);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
