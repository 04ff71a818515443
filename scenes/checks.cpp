#include "scenes/checks.h"

#include "scenes/value_text.h"

#include <functional>
#include <initializer_list>

namespace fluidtex::scenes {
namespace {

// Whether `name` is that of one of the scene's maps, of a kind that does; if not, the fault is added.
bool namesMap(const Scene& scene, const std::string& name, const std::string& key,
              const std::function<bool(texture::MapHolds)>& does, const std::string& unfit,
              const std::string& fit, Reader& reader) {
  std::vector<std::string> names;
  for (const texture::MapOptions& map : scene.texture.exemplar.maps) {
    if (map.name != name) {
      names.push_back(map.name);
    } else if (does(map.holds)) {
      return true;
    } else {
      reader.fault(key, "\"" + name + "\" holds " + unfit, "give a map of " + fit);
      return false;
    }
  }
  const std::string near = nearestName(name, names);
  reader.fault(key, "\"" + name + "\" is no map of this scene",
               near.empty() ? "give the name of a [[texture.map]]" : "did you mean \"" + near + "\"?");
  return false;
}

// key: of the relief's table. A relief that moves the surface needs values.
void checkRelief(const Scene& scene, const render::Bump& relief, const std::string& path, bool moves,
                 Reader& reader) {
  const std::string key = path + ".map";
  if (!reader.clean(key) || !reader.clean(path + ".height") || !reader.clean("texture.map")) return;
  if (relief.map.empty() && reader.given(path + ".height") && relief.height != 0.0)
    reader.fault(
        path + ".height", "is of no use without a map",
        std::string("give map = \"height\", or whatever the [[texture.map]] is named that holds heights") +
            (moves ? "" : " or normals"));
  if (!relief.any()) return;
  if (moves)
    namesMap(
        scene, relief.map, key, [](texture::MapHolds holds) { return holds == texture::MapHolds::values; },
        "vectors, which move nothing", "values", reader);
  else
    namesMap(
        scene, relief.map, key,
        [](texture::MapHolds holds) { return holds != texture::MapHolds::directions; },
        "directions, which make no relief", "values or of normals", reader);
}

void checkMaterial(const Scene& scene, Reader& reader) {
  using render::MaterialKind;
  const render::LiquidMaterial& material = scene.render.material;
  const std::string path = "render.material.";
  if (!reader.clean(path + "kind")) return;
  const auto needs = [&](const char* kind, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (reader.given(path + key) && reader.clean(path + key))
        reader.fault(path + key, "is of no use to a coated liquid",
                     std::string("give kind = \"") + kind + "\" too, or leave it out");
  };
  if (material.kind == MaterialKind::coated) {
    needs("water", {"index", "absorption", "cover"});
    // Another exemplar on the command line takes the glow away.
    if (material.glow > 0.0) needs("lava", {"heat", "coldest", "hottest", "glow"});
  }
  if (material.kind != MaterialKind::lava) return;
  const std::string hottest = path + "hottest", heat = path + "heat";
  if (reader.clean(hottest) && reader.clean(path + "coldest") && !(material.hottest > material.coldest))
    reader.fault(reader.given(hottest) ? hottest : path + "coldest",
                 "the hottest, " + written(material.hottest) + " K, is not above the coldest, " +
                     written(material.coldest) + " K",
                 "give hottest a larger number");
  if (material.glow > 0.0 && !material.heat.empty() && reader.clean(heat) && reader.clean("texture.map"))
    namesMap(
        scene, material.heat, heat,
        [](texture::MapHolds holds) { return holds == texture::MapHolds::values; },
        "vectors, which tell no heat", "values", reader);
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
  checkRelief(scene, render.displacement, "render.displacement", true, reader);
  checkRelief(scene, render.bump, "render.bump", false, reader);
  checkMaterial(scene, reader);
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
