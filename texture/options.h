// Settings of surface preparation and synthesis: what a scene file says about the texture.
#pragma once

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::texture {

enum class Method {
  coordinates,  // ours: every vertex carries where in the exemplar it came from; colour is looked up afresh
  kwatra07,     // the paper's own: colours are carried and averaged [Kwatra07 sec. V-B]
  none,         // no texture: one plain colour
};

// How the frames after the first get theirs; all but the first are for comparison.
enum class LaterFrames {
  synthesize,  // from what was carried
  advect,      // what was carried, and nothing more; colours are carried, since nothing is looked up
  alone,       // each frame like a first one
};

enum class Points {
  seeds,   // the last frame's points moved with the flow, thinned and filled
  random,  // drawn anew on each frame, the paper's way
};

struct SurfaceOptions {
  Points points = Points::seeds;
  int levels = 3;            // of the hierarchy on the first frame that has a surface
  int repulsionSweeps = 16;  // on the first frame and for random points; seeds need a quarter of them
  std::uint64_t seed = 1;
};

// What the columns of the exemplar run along, as far as the field's smoothness lets them.
enum class Align {
  none,
  gravity,    // down the surface
  flow,       // the way the surface moves
  curvature,  // the line in which it bends most; no arrow, so it takes a symmetry of 2 or 4
  direction,  // one direction in space
  field,      // vectors from a file
};

struct OrientationOptions {
  int symmetry = 1;       // equal directions in a full turn: 1, 2 (bricks) or 4 (squares)
  bool mirrored = false;  // the exemplar looks the same with left and right exchanged
  Align align = Align::none;
  double weight = 0.2;  // 0 not at all, 0.5 as much as the neighbouring vertices, 1 whatever they are
  double angle = 0.0;   // degrees from there to the columns, counter-clockwise seen from outside
  openvdb::Vec3d direction{1.0, 0.0, 0.0};
  std::filesystem::path field;  // OpenVDB; its first grid of float vectors
};

// What makes the texture larger in some places than in others.
enum class ScaleBy {
  none,
  distance,     // from shapes, metres; below 0 inside
  temperature,  // K
  height,       // z, metres
  field,        // a grid of numbers from a file
};

// What factors are brought into.
inline constexpr double kLeastScale = 0.25, kLargestScale = 4.0;

// A curve is given by points by rising value; it is linear between them and constant beyond.
struct CurvePoint {
  double value = 0.0, result = 1.0;
};

struct ScaleOptions {
  ScaleBy by = ScaleBy::none;
  std::vector<CurvePoint> points;  // from there to how many times as large an exemplar's pixel is
  std::filesystem::path field;     // OpenVDB; its first grid of floats
};

// What steers which parts of the exemplar appear where.
enum class GuidanceBy {
  none,
  height,       // z, metres
  temperature,  // K
  speed,        // m/s
  vorticity,    // length of the velocity's curl, 1/s
  curvature,    // mean curvature, 1/m, above 0 on crests
  age,          // s since the surface there came to light
  renewal,      // s since the texture there was last renewed
  foam,         // 0..1, see Foam
  field,        // a grid of numbers from a file
};

// Foam appears where the velocity changes from place to place (|grad u|), goes with the surface and fades.
struct Foam {
  double from = 8.0, full = 25.0;  // 1/s: below the first there comes none, from the second on it covers all
  double lifetime = 2.0;           // s until 1/e of it is left
};

struct GuidanceOptions {
  GuidanceBy by = GuidanceBy::none;
  std::vector<CurvePoint> points;  // from there to a level of the guidance map, 0 black to 1 white
  std::filesystem::path field;     // OpenVDB; its first grid of floats
  Foam foam;
};

// How an exemplar may be laid besides upright.
struct Ways {
  int turns = 1;          // 1, 2 or 4: turned by multiples of 360 / turns degrees
  bool mirrored = false;  // each of these mirrored as well, left and right exchanged
};

struct SynthesisOptions {
  Method method = Method::coordinates;
  std::vector<int> windows{33, 17, 9};        // exemplar pixels, odd, falling
  std::vector<int> firstIterations{4, 4, 5};  // a window, on the first frame
  std::vector<int> laterIterations{3, 3, 3};  // a window, on each later frame
  double robustExponent = 0.8;                // r of |s_p - z_p|^r; 2 gives the plain squares of [Kwatra07]
  double softConstraint =
      0.1;  // f: weight of the carried colour where it has mean gradient, 1 = all windows together
  double histogram = 3.0;       // strength of the histogram weights [Kopf07]
  double usage = 0.4;           // penalty on parts of the exemplar used more than the mean
  double core = 0.2;            // weight of a window's centre when its texels are copied
  double featureWeight = 0.3;   // of the signed feature distance channel, squared distance, colour = 1
  double gradientWeight = 0.3;  // of the gradient energy channel
  double guidanceWeight = 1.0;  // of the guidance map, where the exemplar has one
  Ways ways;
  double keepStretch = 1.22;  // carried texture that is coherent and stretched less than this is kept
  double renewalRadius =
      36.0;  // exemplar pixels: texture is renewed in discs of this size, larger than its features
  double renewalRate = 2.4;  // of the whole surface, a second: no more is renewed, the worst places first
  double lookAhead =
      0.5;            // s: new texture is laid for the surface that far ahead, as the flow strains it now
  double fade = 0.8;  // s, from old texture to new; as long rests what is new
  std::uint64_t seed = 1;
};

// Numbers; or vectors in the axes of the picture, which turn with the texture (texture/shown/vector_maps.h).
enum class MapHolds { values, normals, directions };

// A further map that lies over the exemplar, in any resolution: looked up wherever a colour is.
struct MapOptions {
  std::string name;  // of a vertex's property in the PLY
  std::filesystem::path file;
  MapHolds holds = MapHolds::values;
  double weight = 0.0;  // in matching: 1 counts as much as the colours; 0 is only looked up
};

// What pictures show between the points.
enum class Between {
  points,    // their colours, interpolated
  exemplar,  // the exemplar, looked up at every place
  file,      // the same picture in another resolution
};

struct ExemplarOptions {
  std::filesystem::path file;
  bool toroidal = false;           // its left edge continues at its right, its top at its bottom
  std::filesystem::path guidance;  // an image of its size, read as numbers 0..1; empty: none
  std::vector<MapOptions> maps;
  Between between = Between::points;
  std::filesystem::path betweenFile;
};

struct Options {
  ExemplarOptions exemplar;
  // Distance of neighbouring points, metres: one exemplar pixel. 0: chosen so that the first frame that has a
  // surface gets `points` points, or the surface that a scene will have where liquid is still to come.
  double spacing = 0.0;
  int points = 40000;
  // 0 fresh on each frame to 1 kept until it breaks: what laterFrames, keepStretch, renewalRate and fade
  // follow where a scene does not give them.
  double coherence = 0.5;
  LaterFrames laterFrames = LaterFrames::synthesize;
  SurfaceOptions surface;
  ScaleOptions scale;
  GuidanceOptions guidance;
  OrientationOptions orientation;
  SynthesisOptions synthesis;
};

}  // namespace fluidtex::texture
