// One frame from the liquid's motion to its textured surface: surface preparation, transport, orientation,
// guidance, synthesis [Kwatra07 sec. III]. Used by the program, the benchmarks and programs that link the
// library.
#pragma once

#include "pipeline/animation.h"
#include "pipeline/orientation_guide.h"
#include "pipeline/place_factor.h"
#include "pipeline/texture_guidance.h"
#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "texture/frames/synthesize.h"
#include "texture/orientation/orient.h"
#include "texture/surface.h"

#include <functional>
#include <optional>
#include <vector>

namespace fluidtex::pipeline {

// Shared by all frames of a run. The exemplar's search tables are made on first use and kept here.
struct Texturing {
  scenes::Scene scene;
  texture::Synthesizer synthesizer;
  OrientationGuide orientation;
  PlaceFactor scale, renewal;
  texture::TexturedSurface start;  // of the mesh that the liquid begins with, on the exemplar; or empty
  TextureGuidance guidance;
  Animation animation;
};

// Reads what the scene's settings name: exemplar, maps, vector and scalar fields, meshes. cache: folder of
// search tables kept between runs. Throws texture::ExemplarError, sim::MeshError and sim::HeightError;
// std::runtime_error that names a field's file; std::invalid_argument if no window fits the exemplar.
Texturing makeTexturing(const scenes::Scene& scene, const texture::CacheFolder& cache = {});
// The same with an exemplar in memory, prepared for scene.texture.surface.levels levels; where the liquid
// begins with a mesh's texture, it is the mesh's whole picture, and one of its pixels on the mesh is the
// spacing, unless that is given.
Texturing makeTexturing(const scenes::Scene& scene, texture::Exemplar exemplar,
                        const texture::CacheFolder& cache = {});

enum class Stage { prepare, transport, synthesize };

// Callbacks: progress of a frame, and the clock that times its stages.
struct Watch {
  std::function<void(Stage, double part)> progress{};  // part: 0 to 1; an exception ends the frame
  std::function<double()> seconds{};                   // empty: wall time
};

struct FrameSeconds {
  double prepare = 0.0, transport = 0.0, synthesize = 0.0;
};

struct TexturedFrame {
  // Its spacing is set once there is a surface, and kept while there is none.
  texture::TexturedSurface surface;
  texture::SynthesisStats synthesis;
  std::optional<std::vector<texture::Singularity>> singularities;  // unknown without a surface
  bool foreseenSpacing = false;  // chosen in this frame for the surface that is foreseen
  FrameSeconds seconds;
};

// Textures one frame. last: the previous frame's textured surface, empty on the first frame; its spacing is
// kept, else it is scene.texture.spacing, or follows from scene.texture.points. frame.substeps: the motion
// from there to this frame. The result does not depend on the number of threads. Throws std::invalid_argument
// as prepareSurface(), carry(), orient() and synthesize(); std::runtime_error if the frame lacks a scalar
// that scale, renewal, guidance or orientation follow; texture::ExemplarError if a picture of an exemplar
// that moves cannot be read.
TexturedFrame textureFrame(Texturing& texturing, const texture::TexturedSurface& last,
                           const sim::Frame& frame, const Watch& watch = {});

}  // namespace fluidtex::pipeline
