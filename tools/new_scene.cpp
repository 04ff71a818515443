// fluidtex new NAME: a scene to begin with, commented, and a picture for it.
#include "render/render.h"
#include "scenes/exemplars/scales.h"
#include "scenes/numbered_files.h"
#include "texture/exemplar/read_image.h"
#include "texture/exemplar/srgb.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// @EXEMPLAR@ and @TOROIDAL@ are filled in. A line that begins with # and no space behind it is a key at its
// default: without the # it is as valid.
constexpr const char* kTemplate =
    R"(# A scene of fluidtex: what is simulated, how it is textured, how it is drawn.
#   fluidtex check THIS_FILE                     what it will be, and what it costs
#   fluidtex run THIS_FILE --quality preview     a first look
# Units are SI: metres, seconds, kilograms. Z is up. Colours are linear RGB.
# Every key: scenes/README.md. Keys behind a # without a space are at their defaults: take the # off to change them.

frames = 48
#frame_rate = 24.0
#seed = 1              # another one gives another texture of the same kind

# The box in which it all happens, from [0, 0, 0] to its size. Its sides are walls.
[domain]
size = [1.0, 1.0, 1.0]
resolution = 64         # cells along the longest side: twice as many take 8 times the memory, 16 times the time
#sides = { x_high = "open", z_high = "wall" }  # liquid falls off an open side

[fluid]
viscosity = 0.001       # Pa s: water 0.001, oil 0.1, honey 10
#density = 1000.0
#surface_tension = 0.0  # N/m: water 0.072
#gravity = [0.0, 0.0, -9.81]

# Liquid: box, sphere, cylinder, half_space, mesh, height_field, union or difference, as many as you like.
[[liquid]]
box = { min = [0.0, 0.0, 0.0], max = [1.0, 1.0, 0.25] }

[[liquid]]
sphere = { center = [0.4, 0.5, 0.65], radius = 0.2 }
velocity = [0.0, 0.0, -1.0]
#from = 0.0             # s, when it is poured

# What is in the way: the same shapes, at rest or moved by [[solid.keyframe]]s.
[[solid]]
cylinder = { from = [0.8, 0.5, 0.0], to = [0.8, 0.5, 0.6], radius = 0.07 }
#visible = true
#wall = "slip"          # or "no_slip", "friction"

# A tap: the same shapes.
# [[source]]
# sphere = { center = [0.2, 0.5, 0.8], radius = 0.05 }
# velocity = [0.0, 0.0, -1.0]

[texture]
exemplar = @EXEMPLAR@   # the picture that the texture is made of; looked for beside this file
toroidal = @TOROIDAL@   # true: its left edge goes on at its right, its top at its bottom
points = 40000          # one shows one pixel of the exemplar: for 40,000 a picture of about 200 x 200 pixels
#coherence = 0.5        # towards 1 texture is kept longer and stretches more, towards 0 it is renewed sooner

[texture.orientation]
#symmetry = 1           # 2: the picture looks the same turned by half a turn; 4: by quarters. Slower
#mirrored = false       # true: it looks the same mirrored. Slower
#align = "none"         # or "gravity", "flow": what the picture's rows run along

[camera]
from = [2.2, -1.8, 1.5]
at = [0.5, 0.5, 0.3]
#fov = 30.0             # degrees
#turn = 0.0             # degrees around `at` over the whole scene

[light]
#sun_direction = [-0.35, -0.6, 0.75]
#sun_size = 4.0         # degrees: soft shadows

[render]
size = [960, 540]
samples = 32            # paths a pixel, at most: more are slower and less noisy
#gloss = 1.0
#ground = true
#tank = true

# What --quality preview and --quality final change.
[quality.preview]
domain.resolution = 40
texture.points = 8000
render.size = [480, 270]
render.samples = 4

[quality.final]
domain.resolution = 128
texture.points = 160000
render.size = [1920, 1080]
render.samples = 128
render.noise = 0.005
)";

struct NewScene {
  fs::path name, exemplar;
};

std::string filled(std::string text, const std::string& place, const std::string& with) {
  const std::size_t at = text.find(place);
  return text.replace(at, place.size(), with);
}

// The picture that ships with the scenes.
render::Picture scales() {
  const exemplars::Scales options;
  render::Picture picture{options.size, options.size, {}};
  for (const std::uint8_t value : exemplars::makeGreenScales(options))
    picture.rgb.push_back(texture::decodeSrgb(float(value) / 255.0f));
  return picture;
}

void refuseIfThere(const fs::path& file) {
  if (fs::exists(fs::symlink_status(file)))
    throw UsageError(file.string() + ": is there already; give another name");
}

void newScene(const NewScene& wishes) {
  fs::path file = wishes.name;
  if (!file.has_filename())
    throw UsageError(file.string() + ": is no name for a scene; give for example first");
  if (file.extension() != ".toml") file += ".toml";
  const fs::path folder = file.parent_path(), picture = folder / (file.stem().string() + "_scales.png");
  refuseIfThere(file);
  const bool own = !wishes.exemplar.empty();
  std::string exemplar = picture.filename().string();
  if (own) {
    texture::readImage(scenes::firstOf(wishes.exemplar));
    exemplar =
        fs::proximate(fs::absolute(wishes.exemplar), fs::absolute(folder.empty() ? "." : folder)).string();
  } else {
    refuseIfThere(picture);
    writeAtomically(picture, [](const fs::path& temporary) { writePng(scales(), temporary); });
  }
  const std::string text = filled(kTemplate, "@TOROIDAL@", own ? "false" : "true");
  writeTextAtomically(file, filled(text, "@EXEMPLAR@", nlohmann::json(exemplar).dump()));
  print("{}: written{}; next:\n  fluidtex check {}\n  fluidtex run {} --quality preview\n", file.string(),
        own ? "" : ", with " + picture.string(), asTyped(file.string()), asTyped(file.string()));
}

}  // namespace

Command newCommand() {
  const auto wishes = std::make_shared<NewScene>();
  Command command{"new", "Write a commented scene to begin with"};
  command.options = {
      {"name",
       &wishes->name,
       "NAME",
       "The scene's name; NAME.toml is written, and nothing is overwritten",
       {.required = true}},
      {"--exemplar", &wishes->exemplar, "IMAGE",
       "Image to grow the texture from (default: one of green scales is written beside the scene)"},
  };
  command.footer = "Example:\n  fluidtex new first\n  fluidtex run first.toml --quality preview";
  command.run = [wishes] {
    newScene(*wishes);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
