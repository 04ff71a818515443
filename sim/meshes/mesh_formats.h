// Readers of mesh file formats. All three are read here: no library at hand keeps the vertices of an OBJ as
// they are (texture is written back onto them), reads all that programs write, and stays within bounds on
// damaged files (docs/architecture.md).
#pragma once

#include "sim/meshes/read_mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace fluidtex::sim {

// Each takes all of a file, and no more memory than a multiple of its size. Corners may name vertices that do
// not exist, and coordinates may be infinite.
// Throws std::runtime_error; the message continues a sentence that begins with the file's name: "line 7: a
// vertex needs three numbers".

// Faces (f) and vertices (v) of Wavefront OBJ; lines, points, normals, groups and materials are passed over.
// uv: takes the texture coordinates (vt), where it is given.
MeshSoup soupOfObj(std::string_view text, SoupUv* uv = nullptr);

// A property of vertices beside their place.
struct VertexProperty {
  std::string name;
  std::vector<float> values;  // #P, unless the file has several elements `vertex`
};

// Polygon File Format, text or binary of either order, numbers of any type: elements `face` and `tristrips`.
// others: takes the properties of vertices that are no lists, where it is given.
MeshSoup soupOfPly(std::string_view bytes, std::vector<VertexProperty>* others = nullptr);

// Stereolithography, text or binary: three points of its own for each facet.
MeshSoup soupOfStl(std::string_view bytes);

}  // namespace fluidtex::sim
