#include "caches/layouts/programs.h"

#include "caches/formats/read_geometry.h"
#include "foreign/grid.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace fluidtex::caches {
namespace {

using foreign::GridHead;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

// Names of surfaces and velocities, the most usual first.
constexpr std::array kDistanceNames{"surface",  "liquid_surface", "fluid_surface", "sdf",
                                    "levelset", "level_set",      "phi",           "distance"};
constexpr std::array kDensityNames{"density", "fluid", "liquid", "fluid_density"};
constexpr std::array kVelocityNames{"vel", "v", "velocity", "velocities"};
constexpr std::array kNormalNames{"n", "normal", "normals"};
// Numbers that tell points apart: between two of them there is nothing.
constexpr std::array kLabelNames{"id", "ids", "index", "particle_id", "particleid"};

template <class Names>
bool isOneOf(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Fits>
const GridHead* firstOf(const std::vector<GridHead>& grids, const Fits& fits) {
  const auto found = std::find_if(grids.begin(), grids.end(), fits);
  return found == grids.end() ? nullptr : &*found;
}

const GridHead* named(const std::vector<GridHead>& grids, const std::string& name, bool vectors) {
  return firstOf(grids, [&](const GridHead& grid) {
    return grid.readable && grid.vectors == vectors && lower(grid.name) == name;
  });
}

std::string namesOf(const std::vector<GridHead>& grids) {
  std::string text;
  for (const GridHead& grid : grids) text += (text.empty() ? "" : ", ") + grid.name;
  return text.empty() ? "none" : text;
}

const GridHead* surfaceOf(const std::vector<GridHead>& grids, bool& fog) {
  fog = false;
  for (const char* name : kDistanceNames)
    if (const GridHead* grid = named(grids, name, false); grid && grid->gridClass != "fog volume")
      return grid;
  const auto isLevelSet = [](const GridHead& grid) {
    return grid.readable && !grid.vectors && grid.gridClass == "level set";
  };
  if (const GridHead* grid = firstOf(grids, isLevelSet)) return grid;
  fog = true;
  for (const char* name : kDensityNames)
    if (const GridHead* grid = named(grids, name, false)) return grid;
  return firstOf(grids, [](const GridHead& grid) {
    return grid.readable && !grid.vectors && grid.gridClass == "fog volume";
  });
}

std::vector<std::string> velocityOf(const std::vector<GridHead>& grids, bool& onFaces) {
  const auto one = [&](const GridHead& grid) {
    onFaces = grid.gridClass == "staggered";
    return std::vector{grid.name};
  };
  for (const char* name : kVelocityNames)
    if (const GridHead* grid = named(grids, name, true)) return one(*grid);
  const auto three = [&](const std::array<std::string, 3>& names) {
    std::vector<std::string> found;
    for (const std::string& name : names)
      if (const GridHead* grid = named(grids, name, false)) found.push_back(grid->name);
    return found.size() == 3 ? found : std::vector<std::string>{};
  };
  for (const std::string base : kVelocityNames)
    for (const std::string between : {".", "", "_"})
      if (auto names = three({base + between + "x", base + between + "y", base + between + "z"});
          !names.empty())
        return names;
  if (auto names = three({"u", "v", "w"}); !names.empty()) return names;
  if (const GridHead* grid =
          firstOf(grids, [](const auto& other) { return other.readable && other.vectors; }))
    return one(*grid);
  return {};
}

// "a, b, c" in its parts.
std::vector<std::string> parts(const std::string& names) {
  std::vector<std::string> result;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t comma = std::min(names.find(',', begin), names.size());
    while (begin < comma && names[begin] == ' ') ++begin;
    std::size_t end = comma;
    while (end > begin && names[end - 1] == ' ') --end;
    result.push_back(names.substr(begin, end - begin));
    begin = comma + 1;
  }
  return result;
}

std::vector<std::string> givenVelocity(const std::filesystem::path& file, const std::vector<GridHead>& grids,
                                       const std::string& given, bool& onFaces) {
  std::vector<std::string> names = parts(given);
  if (names.size() != 1 && names.size() != 3)
    throw LayoutError("files.velocity_name: \"" + given + "\" names " + std::to_string(names.size()) +
                      " grids; name one of vectors, or three, \"u,v,w\"");
  for (const std::string& name : names) {
    const GridHead* grid = firstOf(grids, [&](const GridHead& other) {
      return other.name == name && other.readable && other.vectors == (names.size() == 1);
    });
    if (!grid)
      throw LayoutError(file.string() + ": holds no grid of " + (names.size() == 1 ? "vectors" : "numbers") +
                        " named \"" + name + "\"; there are: " + namesOf(grids));
    onFaces = names.size() == 1 && grid->gridClass == "staggered";
  }
  return names;
}

std::string velocityOf(const Geometry& geometry) {
  for (const char* wanted : kVelocityNames)
    for (const auto& [name, attribute] : geometry.attributes)
      if (attribute.components == 3 && lower(name) == wanted) return name;
  return {};
}

std::string givenVelocity(const std::filesystem::path& file, const Geometry& geometry,
                          const std::string& given) {
  const auto found = geometry.attributes.find(given);
  if (found != geometry.attributes.end() && found->second.components == 3) return given;
  std::string there;
  for (const auto& [name, attribute] : geometry.attributes)
    if (attribute.components == 3) there += (there.empty() ? "" : ", ") + name;
  throw LayoutError(file.string() + ": has no attribute of vectors \"" + given +
                    "\"; there are: " + (there.empty() ? "none" : there));
}

}  // namespace

GridChoice chooseGrids(const std::filesystem::path& file, const Options& options) {
  std::vector<GridHead> grids;
  try {
    grids = foreign::listGrids(file);
  } catch (const foreign::Unreadable& error) {
    throw LayoutError(file.string() + ": " + error.what());
  }
  GridChoice choice;
  if (grids.empty()) return choice;
  if (options.surfaceName.empty()) {
    if (const GridHead* grid = surfaceOf(grids, choice.fog)) choice.surface = grid->name;
  } else {
    const GridHead* grid =
        firstOf(grids, [&](const GridHead& other) { return other.name == options.surfaceName; });
    if (!grid || !grid->readable || grid->vectors)
      throw LayoutError(file.string() + ": holds no grid of numbers named \"" + options.surfaceName +
                        "\" that can be a surface; there are: " + namesOf(grids));
    choice.surface = grid->name;
    choice.fog = grid->gridClass == "fog volume" || (options.iso != 0.0 && grid->gridClass != "level set");
  }
  choice.velocity = options.velocityName.empty()
                        ? velocityOf(grids, choice.onFaces)
                        : givenVelocity(file, grids, options.velocityName, choice.onFaces);
  for (const GridHead& grid : grids)
    if (grid.readable && grid.name != choice.surface && !grid.name.empty() &&
        std::find(choice.velocity.begin(), choice.velocity.end(), grid.name) == choice.velocity.end())
      (grid.vectors ? choice.vectors : choice.scalars).push_back(grid.name);
  return choice;
}

AttributeChoice chooseAttributes(const std::filesystem::path& file, const Options& options) {
  const Geometry geometry = readGeometry(file);
  AttributeChoice choice;
  choice.points = !geometry.points.empty();
  if (!choice.points) return choice;
  choice.triangles = !geometry.triangles.empty();
  choice.velocity = options.velocityName.empty() ? velocityOf(geometry)
                                                 : givenVelocity(file, geometry, options.velocityName);
  for (const auto& [name, attribute] : geometry.attributes) {
    if (attribute.components == 1 && !isOneOf(kLabelNames, lower(name))) choice.scalars.push_back(name);
    if (attribute.components == 3 && name != choice.velocity && !isOneOf(kNormalNames, lower(name)))
      choice.vectors.push_back(name);
  }
  return choice;
}

}  // namespace fluidtex::caches
