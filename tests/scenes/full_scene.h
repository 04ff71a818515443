// A scene in which everything is said, and a look at the keys of what becomes of it.
#pragma once

#include "tests/scenes/scene_file.h"

#include <nlohmann/json.hpp>

#include <set>
#include <string>

namespace fluidtex::scenes {

using Json = nlohmann::json;

inline Scene sceneOf(const std::string& text) {
  const SceneFolder folder;
  return loadScene(folder.write("s.toml", text));
}

// The keys of all tables, dotted, numbers of list members left out.
inline void collectKeys(const Json& value, const std::string& path, std::set<std::string>& keys) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      collectKeys(inner, path.empty() ? key : path + "." + key, keys);
  } else if (value.is_array() && !value.empty() && value[0].is_object()) {
    for (const Json& inner : value) collectKeys(inner, path, keys);
  } else if (!value.is_array() || !value.empty()) {
    keys.insert(path);
  }
}

// A scene in which every key of the schema is given, none with its default.
inline const std::string kFullScene = R"(
name = "all of it"
frames = 5
frame_rate = 30
seed = 99
[domain]
size = [3, 2, 1.5]
resolution = 48
[domain.sides]
x_low = "stream"
x_high = "open"
y_low = "open"
y_high = "stream"
z_low = "open"
z_high = "stream"
[fluid]
density = 900
viscosity = 0.5
surface_tension = 0.07
gravity = [1, 0, -3]
[heat]
simulate = true
capacity = 1000
conductivity = 2
emissivity = 0.5
ambient = 300
wall_transfer = 10
wall_temperature = 400
law = "table"
reference = 1300
slope = 0.1
activation_energy = 150000
solidus = 900
solid_viscosity = 5e5
[[heat.point]]
temperature = 1000
viscosity = 1e5
[[heat.point]]
temperature = 1400
viscosity = 10
[simulation]
cfl = 1.5
[[wall]]
wall = "no_slip"
wall_velocity = [0, 1, 2]
[[wall]]
face = "x_high"
wall = "friction"
slip_length = 0.5
[[liquid]]
box = { min = [0, 0.5, 0], max = [1, 1, 0.5] }
velocity = [1, 2, 3]
from = 0.25
temperature = 1500
[[liquid]]
union = [ { sphere = { center = [1, 1, 1], radius = 0.5 } }, { difference = [ { half_space = { point = [0, 0, 0.1], normal = [0, 0, 2] } }, { mesh = { file = "m.obj", up = "y", rotate = [0, 0, 45], scale = 2, translate = [3, 2, 1] } } ] } ]
[[solid]]
name = "gate"
mesh = { file = "m.obj" }
from = 0.5
until = 0.75
wall = "friction"
slip_length = 0.25
wall_velocity = [1, 0, 0]
visible = false
color = [1, 0.25, 0]
[[solid]]
sphere = { center = [1, 1, 1], radius = 0.5 }
until = inf
pivot = [1, 2, 3]
axis = [1, 0, 0]
[[solid.keyframe]]
time = 0.5
[[solid.keyframe]]
time = 1.5
move = [0, 0, 1]
turn = 720
[[solid]]
mesh_sequence = { files = "m_%d.obj", first = 0, last = 2, frame_rate = 12, start = 0.5, up = "y", rotate = [1, 2, 3], scale = 3, translate = [1, 0, 2] }
[[source]]
cylinder = { from = [0, 0, 1], to = [1, 0, 1], radius = 0.25 }
velocity = [1, 0, 0]
temperature = 1400
from = 0.5
until = 8
[[source.rate]]
time = 0
factor = 0.5
[[source.rate]]
time = 2
factor = 1.5
[[drain]]
height_field = { file = "e.png", pixel = 0.5, low = -1, high = 2, translate = [0, 1, 2] }
from = 1
until = 2
[texture]
exemplar = "e.png"
toroidal = true
between = "file"
between_file = "e.png"
points = 1234
method = "kwatra07"
later_frames = "advect"
windows = [21, 11]
first_iterations = [7, 8]
later_iterations = [0, 2]
robust_exponent = 1.5
soft_constraint = 0.7
histogram = 1
usage = 2
core = 0.9
feature = 0.4
gradient = 0.6
rest_frames = 12
coherence = 0.75
keep_stretch = 2
renewal_radius = 20
renewal_rate = 5
look_ahead = 0.125
fade = 0.25
[texture.surface]
points = "random"
levels = 4
repulsion_sweeps = 12
[texture.scale]
by = "field"
field = "f.vdb"
[[texture.scale.point]]
value = 1
factor = 0.5
[[texture.scale.point]]
value = 2
factor = 3
[[texture.scale.from]]
sphere = { center = [1, 1, 1], radius = 0.25 }
[texture.renewal]
by = "distance"
point = [ { value = 0, factor = 0 }, { value = 0.5, factor = 4 } ]
from = [ { sphere = { center = [1, 1, 1], radius = 0.5 } } ]
[texture.start]
file = "m.obj"
up = "y"
rotate = [4, 5, 6]
scale = 0.5
translate = [3, 2, 1]
renew = false
[texture.guidance]
by = "field"
map = "e.png"
weight = 2
field = "f.vdb"
[[texture.guidance.point]]
value = 1
level = 0.5
[[texture.guidance.point]]
value = 2
level = 0.75
[[texture.map]]
name = "height"
file = "e.png"
holds = "normals"
[[texture.map]]
name = "bumps"
file = "e.png"
weight = 0.5
[texture.orientation]
symmetry = 2
mirrored = true
align = "field"
weight = 0.75
angle = 30
direction = [0, 1, 0]
field = "f.vdb"
[[texture.orientation.keep_clear]]
sphere = { center = [1, 1, 1], radius = 0.25 }
[texture.transport]
method = "grid"
orientation = "scalars"
[texture.onto]
files = "t_%d.obj"
first = 0
up = "y"
rotate = [3, 2, 1]
scale = 2
translate = [1, 2, 3]
[camera]
from = [9, 8, 7]
at = [1, 2, 3]
fov = 50
turn = -90
aperture = 0.01
focus = 2
shutter = 0.5
[light]
sun_direction = [0, 0, 1]
sun_color = [1, 2, 3]
sun_size = 1
sky_color = [0.1, 0.2, 0.3]
horizon_color = [0.4, 0.5, 0.6]
[render]
size = [320, 180]
samples = 2
noise = 0.01
smooth = false
bounces = 1
gloss = 0.5
roughness = 0.25
exposure = 1.25
ground = false
ground_color = [0.1, 0.1, 0.1]
tank = false
tank_color = [0.2, 0.2, 0.2]
[render.material]
kind = "lava"
index = 1.4
absorption = [3, 2, 1]
cover = 0.5
heat = "bumps"
coldest = 700
hottest = 1500
glow = 2
[render.displacement]
map = "bumps"
height = 1.5
[render.bump]
map = "bumps"
height = 2.5
)";

}  // namespace fluidtex::scenes
