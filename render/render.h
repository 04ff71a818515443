// A path tracer for textured liquid: diffuse vertex colours under a clear coat, sun and sky.
#pragma once

#include "render/options.h"
#include "texture/surface.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::render {

struct Picture {
  int width = 0, height = 0;
  std::vector<float> rgb;  // height x width x 3, linear, rows from the top; render() gives values in 0..1
};

// A solid of the scene, matt, in one colour.
struct Solid {
  std::vector<texture::Vec3f> positions;
  std::vector<texture::Vec3I> triangles;
  Vec3d color;  // linear
};

// Linear RGBA, straight alpha, of the liquid inside a triangle at barycentric weights; nothing where the
// vertices' colours are interpolated. Called from any thread.
using ColorBetween = std::function<std::optional<texture::Vec4f>(std::uint32_t, const texture::Vec3f&)>;

struct View {
  Vec3d domainSize;  // metres; the domain has tank and ground around it
  // Position of a turning camera: 0 at the first, 1 at the last frame of the animation.
  double progress = 0.0;
  int frame = 1;              // keys the random numbers
  ColorBetween colorBetween;  // empty: the vertices' colours, interpolated
  bool seeThrough = false;    // colorBetween may give alpha below 1
  Vec3d domainOrigin{0.0};    // the domain's lowest corner
  double frameRate = 24.0;    // frames a second, by which the shutter counts
  bool textured = true;       // else its colours are none, and clear liquid is seen through everywhere
};

// Renders a picture; the result does not depend on the number of threads. An empty surface gives the
// surroundings alone. progress: called with 0..1, from one thread at a time. Throws std::invalid_argument if
// width or height is below 1, samples are not within 1..65536, bounces or roughness are negative, an array
// does not have one entry per vertex, or a triangle's corner does not exist; also as makeCamera(), makeSky()
// and bumpedNormals(). Throws std::bad_alloc or std::runtime_error if Embree fails.
Picture render(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
               const Options& options, const View& view, const std::function<void(double)>& progress = {});

// Tone mapping in place, which render() includes: multiplies linear radiance by `exposure` and compresses
// values above 0.8 exponentially to at most 1. NaN becomes 0.
void develop(Picture& picture, double exposure);

// Text that is kept in a picture's file, UTF-8: a PNG keyword ("Title", of 79 Latin letters at most) and what
// it says.
struct PictureNote {
  std::string key, text;
};

// Writes sRGB, 8 bits, PNG; the same picture and notes give the same bytes. Throws std::runtime_error that
// names the file. Not atomic: the caller gives a temporary name and renames.
void writePng(const Picture& picture, const std::filesystem::path& file, std::vector<PictureNote> notes = {});

// Encodes frames first..last, FOLDER/frameName(FRAME).png, with ffmpeg: MP4, H.264, yuv420p, bt709. An odd
// last row or column is cropped. Throws std::runtime_error that names the file and the reason: no frames, a
// missing picture, a frame rate not above 0, ffmpeg not found or failed (its last line), or an incomplete
// file.
void writeVideo(const std::filesystem::path& folder, int first, int last, double frameRate,
                const std::filesystem::path& file);

}  // namespace fluidtex::render
