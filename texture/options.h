// Settings of surface preparation and synthesis, as a scene file gives them.
#pragma once

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::texture {

enum class Method {
  coordinates,  // exemplar coordinates are transported; colour is looked up afresh on each frame
  kwatra07,     // colours are transported and averaged [Kwatra07 sec. V-B]
  none,         // no texture: one plain colour
};

// How frames after the first are textured. All but `synthesize` are for comparison.
enum class LaterFrames {
  synthesize,  // from the transported texture
  advect,      // transport alone, of colours
  alone,       // each frame like a first frame
  birth,       // projected from the position where the surface came to light
  dualRest,    // projected from two rest positions that are reset in turn
};

enum class Points {
  seeds,   // the last frame's points advected, thinned and filled
  random,  // drawn anew on each frame [Kwatra07]
};

struct SurfaceOptions {
  Points points = Points::seeds;
  int levels = 3;            // of the pyramid, on the first frame that has a surface
  int repulsionSweeps = 16;  // on the first frame and for random points; a quarter of them for seeds
  std::uint64_t seed = 1;
};

// Direction that the exemplar's rows follow, left to right, as far as the smoothness of the field allows.
enum class Align {
  none,
  gravity,    // downhill along the surface
  flow,       // tangential velocity
  curvature,  // principal direction of the larger curvature; a line, so it needs a symmetry of 2 or 4
  direction,  // one direction in space
  field,      // vector field from a file
  attribute,  // vectors of the liquid's own, by name
};

struct OrientationOptions {
  int symmetry = 1;       // rotational symmetry N of the exemplar: 1, 2 (bricks) or 4 (squares)
  bool mirrored = false;  // the exemplar looks the same mirrored left to right
  Align align = Align::none;
  double weight = 0.2;  // of the alignment: 0 none, 0.5 as much as all neighbours, 1 hard constraint
  double angle = 0.0;   // degrees from the alignment to the rows, counter-clockwise seen from outside
  openvdb::Vec3d direction{1.0, 0.0, 0.0};
  std::filesystem::path field;  // OpenVDB file; its first grid of float vectors
  std::string attribute;        // scalars of sim::Frame::fields, each with _x, _y and _z behind this name
};

// Quantity that a factor depends on.
enum class FactorBy {
  none,
  distance,     // signed distance from shapes, metres, negative inside
  temperature,  // K
  height,       // z, metres
  field,        // scalar grid from a file
  attribute,    // scalar of the liquid's own, by name
};

// Factors on the side of an exemplar pixel are clamped to this range.
inline constexpr double kLeastScale = 0.25, kLargestScale = 4.0;
// Largest factor on the wear of texture: beyond it, texture as it is laid would count as worn.
inline constexpr double kMostWear = 10.0;

// Point of a piecewise linear curve, constant beyond its ends. Points are sorted by rising value.
struct CurvePoint {
  double value = 0.0, result = 1.0;
};

// A factor from place to place; 1 everywhere where it follows nothing.
struct FactorOptions {
  FactorBy by = FactorBy::none;
  std::vector<CurvePoint> points;  // to the factor
  std::filesystem::path field;     // OpenVDB file; its first float grid
  std::string attribute;           // of sim::Frame::fields
};

// Quantity that steers which parts of the exemplar appear where.
enum class GuidanceBy {
  none,
  height,       // z, metres
  temperature,  // K
  mixture,      // 0..1, of the scene's liquids
  speed,        // m/s
  vorticity,    // |curl u|, 1/s
  curvature,    // mean curvature, 1/m, positive on crests
  age,          // s since this part of the surface was newly exposed
  renewal,      // s since its texture was last renewed
  foam,         // 0..1, see Foam
  field,        // scalar grid from a file
  attribute,    // scalar of the liquid's own, by name
};

// Foam arises where |grad u| is large, is advected with the surface and decays.
struct Foam {
  double from = 8.0, full = 25.0;  // |grad u|, 1/s: none is made below `from`, full cover from `full` on
  double lifetime = 2.0;           // s until it has decayed to 1/e
};

struct GuidanceOptions {
  GuidanceBy by = GuidanceBy::none;
  std::vector<CurvePoint> points;  // to a level of the guidance map, 0 (black) to 1 (white)
  std::filesystem::path field;     // OpenVDB file; its first float grid
  std::string attribute;           // of sim::Frame::fields
  Foam foam;
};

// Symmetry variants in which the exemplar may be laid besides upright.
struct Ways {
  int turns = 1;          // 1, 2 or 4: rotations by multiples of 360 / turns degrees
  bool mirrored = false;  // each rotation mirrored left to right as well
};

struct SynthesisOptions {
  Method method = Method::coordinates;
  std::vector<int> windows{33, 17, 9};        // widths in exemplar pixels: odd, in falling order
  std::vector<int> firstIterations{4, 4, 5};  // per window, on the first frame
  std::vector<int> laterIterations{3, 3, 3};  // per window, on later frames
  double robustExponent = 0.8;  // r of the norm |s_p - z_p|^r; 2: plain squares as in [Kwatra07]
  double softConstraint =
      0.1;  // f: weight of the transported colour where it is constant; 1: as much as all windows
  double histogram = 3.0;       // strength of the histogram weights [Kopf07]
  double usage = 0.4;           // penalty on parts of the exemplar that are used more than the mean
  double core = 0.2;            // weight of (1 - fall-off)^2 when texels are copied: prefers centres
  double featureWeight = 0.3;   // of the signed feature distance channel in squared distances; colour = 1
  double gradientWeight = 0.3;  // of the gradient energy channel
  double guidanceWeight = 1.0;  // of the guidance channel, where the exemplar has a guidance map
  Ways ways;
  double keepStretch = 1.22;  // transported texture that is coherent and stretched less than this is kept
  double renewalRadius =
      36.0;  // exemplar pixels: nominal radius of renewal regions, larger than the exemplar's features
  double renewalRate = 2.4;  // 1/s: largest share of the surface to renew per second, worst regions first
  double lookAhead =
      0.5;            // s: new texture is laid for the surface as the present strain rate deforms it by then
  double fade = 0.8;  // s of the cross-fade; a vertex is not renewed again before it ends
  std::uint64_t seed = 1;
};

// Scalars, or vectors in the axes of the exemplar, which turn with the texture (texture/shown/vector_maps.h).
enum class MapHolds { values, normals, directions };

// A further map over the exemplar, in any resolution, looked up at the exemplar coordinates.
struct MapOptions {
  std::string name;  // name of the vertex property in the PLY
  std::filesystem::path file;
  MapHolds holds = MapHolds::values;
  double weight = 0.0;  // in matching, relative to colour; 0: looked up only
};

// Colour between the points in rendered pictures.
enum class Between {
  points,    // interpolated from the points
  exemplar,  // looked up in the exemplar
  file,      // looked up in the same picture at another resolution
};

// What decides which picture of a sequence a place shows.
enum class ShowBy {
  time,
  guidance,  // the level that texture.guidance gives, 0: the first picture, to 1: the last
};

// An exemplar that moves: pictures of one size, whose texels are the same places at different times.
struct AnimationOptions {
  std::filesystem::path pattern;             // with %d or %04d for the number; empty: one picture that stays
  int first = 0;                             // number of the first picture
  std::vector<std::filesystem::path> files;  // all of them, in order
  double rate = 24.0;                        // pictures a second
  bool loop = true;                          // the first follows the last; else the last stays
  ShowBy by = ShowBy::time;
};

struct ExemplarOptions {
  std::filesystem::path file;  // of a sequence the first
  int halvings = 0;            // of the picture, before anything is made of it
  bool toroidal = false;       // periodic: the left edge continues at the right edge, the top at the bottom
  std::filesystem::path guidance;  // image of the exemplar's size, read as numbers 0..1; empty: none
  std::vector<MapOptions> maps;
  Between between = Between::points;
  std::filesystem::path betweenFile;
  AnimationOptions animation;
};

struct Options {
  ExemplarOptions exemplar;
  // Distance of neighbouring points, metres: side of one exemplar pixel. 0: chosen so that the first frame
  // that has a surface gets `points` points, or the surface that a scene will have where liquid is still to
  // come.
  double spacing = 0.0;
  int points = 40000;
  // 0: each frame textured afresh, to 1: texture kept until it tears. Sets laterFrames, keepStretch,
  // renewalRate and fade where a scene does not give them.
  double coherence = 0.5;
  LaterFrames laterFrames = LaterFrames::synthesize;
  int restFrames = 24;  // of LaterFrames::dualRest: frames between resets
  SurfaceOptions surface;
  FactorOptions scale;    // on the side of an exemplar pixel
  FactorOptions renewal;  // on the wear of texture: 0 never renewed, 1 as elsewhere, above 1 renewed sooner
  GuidanceOptions guidance;
  OrientationOptions orientation;
  SynthesisOptions synthesis;
};

// Whether colours are looked up at exemplar coordinates.
inline bool looksUp(const Options& options) {
  return options.synthesis.method == Method::coordinates &&
         (options.laterFrames == LaterFrames::synthesize || options.laterFrames == LaterFrames::alone);
}

// Whether colours are projected from rest positions.
inline bool isProjected(const Options& options) {
  return options.synthesis.method != Method::none &&
         (options.laterFrames == LaterFrames::birth || options.laterFrames == LaterFrames::dualRest);
}

// Whether the exemplar moves: where colours are carried, its first picture stays.
inline bool moves(const Options& options) {
  return !options.exemplar.animation.files.empty() && looksUp(options);
}

}  // namespace fluidtex::texture
