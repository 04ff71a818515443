// The layouts that are known by their folders.
#pragma once

#include "caches/layouts/layout.h"

#include <optional>

namespace fluidtex::caches {

// Each: nothing where the folder is no cache of this program, and LayoutError where it is one that lacks
// something.

// Blender's liquid: folders config, data and mesh. Also found from one of these, and from the folder above.
std::optional<Layout> mantaflowCache(const std::filesystem::path& folder, const Options& options);

// FLIP Fluids' bakefiles: also from the folder above.
std::optional<Layout> flipFluidsCache(const std::filesystem::path& folder);

// The grids of an OpenVDB file that hold a surface and a velocity, by convention where no name is given.
// Throws LayoutError: unreadable, or without those that are named, unless it has no grids at all.
struct GridChoice {
  std::string surface;  // empty: none
  bool fog = false;
  std::vector<std::string> velocity;  // none, one of vectors, or three
  bool onFaces = false;
  std::vector<std::string> scalars, vectors;  // all others, by name
};
GridChoice chooseGrids(const std::filesystem::path& file, const Options& options);

// The attribute of a geometry file that holds velocity, by convention where no name is given; empty: none.
// Throws FormatError, and LayoutError where one is named and missing, unless there are no points.
struct AttributeChoice {
  bool points = false;  // whether there are any; without them the rest says nothing
  bool triangles = false;
  std::string velocity;
  std::vector<std::string> scalars, vectors;  // all others, by name, but for normals and labels
};
AttributeChoice chooseAttributes(const std::filesystem::path& file, const Options& options);

}  // namespace fluidtex::caches
