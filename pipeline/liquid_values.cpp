#include "pipeline/liquid_values.h"

#include "pipeline/scalars.h"
#include "texture/map_names.h"

#include <algorithm>

namespace fluidtex::pipeline {
namespace {

using texture::TexturedSurface;

const std::string kPrefix = "liquid_";

std::string nameOn(const TexturedSurface& surface, const std::string& name) {
  const auto isPart = [&](const auto& vectors) {
    const std::vector<std::string> parts = texture::vectorNames(vectors.first);
    return std::find(parts.begin(), parts.end(), name) != parts.end();
  };
  const bool taken = texture::isReservedName(name) || surface.maps.contains(name) ||
                     std::any_of(surface.vectors.begin(), surface.vectors.end(), isPart);
  return taken ? kPrefix + name : name;
}

}  // namespace

void addLiquidValues(const sim::Frame& frame, TexturedSurface& surface) {
  std::map<std::string, std::vector<float>> values;
  for (const auto& [name, field] : frame.fields)
    values[nameOn(surface, name)] = sampled(*field, surface.positions);
  surface.maps.merge(values);
}

void setLiquidValues(const std::map<std::string, std::vector<float>>& values, TexturedSurface& surface) {
  for (const auto& [name, numbers] : values) {
    const std::string prefixed = kPrefix + name;
    surface.maps[surface.maps.contains(prefixed) || texture::isReservedName(name) ? prefixed : name] =
        numbers;
  }
}

}  // namespace fluidtex::pipeline
