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
};

// Renders a picture; the result does not depend on the number of threads. An empty surface gives the
// surroundings alone.
Picture render(const texture::TexturedSurface& surface, const std::vector<Solid>& solids,
               const Options& options, const View& view, const std::function<void(double)>& progress = {});

// Makes radiance, linear and without exposure, the values of a picture, 0..1: what is brighter than 0.8 is
// bent to stay below 1. render() does so itself.
void develop(Picture& picture, double exposure);

// Text that is kept in a picture's file, UTF-8: a PNG keyword ("Title", of 79 Latin letters at most) and what
// it says.
struct PictureNote {
  std::string key, text;
};

// Writes sRGB, 8 bits, PNG; the same picture and notes give the same bytes. Throws std::runtime_error that
// names the file. Not atomic: the caller gives a temporary name and renames.
void writePng(const Picture& picture, const std::filesystem::path& file, std::vector<PictureNote> notes = {});

// Encodes frames first..last, FOLDER/frameName(FRAME).png, as H.264, yuv420p, bt709. Throws
// std::runtime_error with ffmpeg's last line of output.
void writeVideo(const std::filesystem::path& folder, int first, int last, double frameRate,
                const std::filesystem::path& file);

}  // namespace fluidtex::render
