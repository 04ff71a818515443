// A textured surface as other programs take it: triangles with named columns of vertices and of corners.
// Built once a frame; each format writes it (glb.h, obj.h, usda.h, vtp.h).
#pragma once

#include "texture/surface.h"

#include <string>
#include <vector>

namespace fluidtex::tools {

// What becomes of triangles whose corners show different pieces of the exemplar, between which no coordinate
// can be interpolated (texture/joints/joints.h).
enum class JointsAs {
  cut,   // they are cut, so that each part is of one piece: one UV set, hard joints, in any program
  blend  // a UV set for the piece of each corner, whose look-ups are to be mixed: soft joints
};

// Values of one name, one row behind the other.
struct Column {
  std::string name;
  int components = 1;
  std::vector<float> values;
};

// Metres, Z up. Maps that hold a vector, NAME_x NAME_y NAME_z or NAME_red NAME_green NAME_blue, are one
// column NAME; NAME_ where that is the name of something else. UV sets have their origin top left, t
// downwards; beyond 0..1 the exemplar is repeated if it is toroidal, else clamped. They are st, and fade_st
// of the place that was shown before, and are columns of vertices where joints are cut. Where they blend they
// are columns of corners, st1 st2 fade_st1 fade_st2 too: st belongs to the piece of the triangle's first
// corner, st1 of the second, st2 of the third, and `joint` are the three weights.
struct ExportMesh {
  int frame = 1;
  double time = 0.0;                      // s
  std::vector<texture::Vec3f> positions;  // #V
  std::vector<texture::Vec3f> normals;    // #V, unit
  std::vector<texture::Vec3I> triangles;  // #T, counter-clockwise seen from outside
  std::vector<texture::Vec4f> color;      // #V, linear RGBA, straight alpha
  std::vector<Column> vertex;             // #V rows each
  std::vector<Column> corner;             // 3 #T rows each; none where joints are cut
};

// lookedUp: the surface's colours are looked up in the exemplar; there are no UV sets otherwise, and joints
// do not matter.
ExportMesh exportMesh(const texture::TexturedSurface& surface, bool lookedUp, bool toroidal, JointsAs joints,
                      int frame, double time);

// The UV sets that there may be, in the order in which formats number them.
inline constexpr const char* kUvSets[] = {"st", "st1", "st2", "fade_st", "fade_st1", "fade_st2"};
bool isUvSet(const std::string& name);

// The column of that name; null if there is none.
const Column* findColumn(const std::vector<Column>& columns, const std::string& name);

// The mesh for formats that know values of vertices alone: a vertex is there once for each different row of
// the corners' columns around it, and these are columns of vertices then. Vertices keep their numbers;
// further copies follow behind the last. Vertices of no triangle have zeros there.
ExportMesh splitAtCorners(const ExportMesh& mesh);

// Rows of a corner column that differ, each once, and which one each corner has (3 #T), for formats with
// indices of their own for them.
struct IndexedColumn {
  std::vector<std::uint32_t> first;  // a corner that has the row
  std::vector<std::uint32_t> index;  // of each corner into `first`
};
IndexedColumn indexed(const ExportMesh& mesh, const std::vector<const Column*>& columns);

}  // namespace fluidtex::tools
