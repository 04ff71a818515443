// Two triangles of a square of 1 m, in the plane z = 2, with every kind of column.
#pragma once

#include "tools/formats/export_mesh.h"

#include <sstream>

inline fluidtex::tools::ExportMesh sampleMesh() {
  fluidtex::tools::ExportMesh mesh;
  mesh.frame = 7;
  mesh.time = 0.25;
  mesh.positions = {{0, 0, 2}, {1, 0, 2}, {1, 3, 2}, {0, 3, 2}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.color = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {0.5f, 0.5f, 0.5f, 1}};
  mesh.vertex = {{"velocity", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
                 {"age", 1, {0.5f, 1.5f, 2.5f, 3.5f}},
                 {"st", 2, {0.25f, 0.125f, 1.25f, 0.125f, 1.25f, 0.75f, 0.25f, 0.75f}},
                 {"fade_st", 2, {0, 0, 1, 0, 1, 1, 0, 1}}};
  return mesh;
}

// The same with a UV set of the corners: the second triangle shows another piece.
inline fluidtex::tools::ExportMesh samplePieces() {
  fluidtex::tools::ExportMesh mesh = sampleMesh();
  mesh.vertex.resize(2);
  mesh.corner = {{"st", 2, {0, 0, 1, 0, 1, 1, 0, 0, 0.5f, 0.5f, 0, 1}}};
  return mesh;
}

// The file that a writer makes.
template <typename Write>
std::string written(const Write& write) {
  std::ostringstream out;
  write(out);
  return out.str();
}
