#include "scenes/checks.h"

namespace fluidtex::scenes {
namespace {

void checkBump(const Scene& scene, Reader& reader) {
  const render::Bump& bump = scene.render.bump;
  const std::string path = "render.bump", key = path + ".map";
  if (!reader.clean(key) || !reader.clean(path + ".height") || !reader.clean("texture.map")) return;
  if (bump.map.empty() && reader.given(path + ".height") && bump.height != 0.0)
    reader.fault(
        path + ".height", "is of no use without a map",
        "give map = \"height\", or whatever the [[texture.map]] is named that holds heights or normals");
  if (!bump.any()) return;
  std::vector<std::string> names;
  for (const texture::MapOptions& map : scene.texture.exemplar.maps) {
    if (map.name != bump.map) {
      names.push_back(map.name);
    } else if (map.holds == texture::MapHolds::directions) {
      return reader.fault(key, "\"" + bump.map + "\" holds directions, which make no relief",
                          "give a map of values or of normals");
    } else {
      return;
    }
  }
  const std::string near = nearestName(bump.map, names);
  reader.fault(key, "\"" + bump.map + "\" is no map of this scene",
               near.empty() ? "give the name of a [[texture.map]]" : "did you mean \"" + near + "\"?");
}

void checkPicture(const Scene& scene, Reader& reader) {
  const render::Options& render = scene.render;
  if (reader.clean("camera.from") && reader.clean("camera.at") && render.camera.from == render.camera.at) {
    reader.fault(reader.given("camera.from") ? "camera.from" : "camera.at",
                 "the camera stands at the point it looks at",
                 "give camera.from and camera.at different places");
  }
  if (reader.clean("light.sun_direction") && render.light.sunDirection.length() == 0.0)
    reader.fault("light.sun_direction", "has no length",
                 "give the direction towards the sun, for example [-0.5, -0.4, 0.8]");
  for (int side : {render.width, render.height}) {
    if (reader.clean("render.size") && side % 2 != 0) {
      reader.fault("render.size", std::to_string(side) + " is odd",
                   "give even numbers, as the video needs, for example " + std::to_string(side + 1));
    }
  }
  checkBump(scene, reader);
}

}  // namespace

void check(const Scene& scene, Reader& reader) {
  if (reader.clean("name") && scene.name.find_first_of("/\\") != std::string::npos)
    reader.fault("name", "\"" + scene.name + "\" holds a slash", "give a name that can be a file's");
  if (reader.clean("name") && (scene.name == "." || scene.name == ".."))
    reader.fault("name", "\"" + scene.name + "\" is a folder", "give a name that can be a file's");
  checkLiquid(scene, reader);
  checkTexture(scene, reader);
  checkPicture(scene, reader);
}

}  // namespace fluidtex::scenes
