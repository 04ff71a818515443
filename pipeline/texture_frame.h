// One frame's way from the liquid's motion to its textured surface: surface preparation, transport,
// orientation, guidance, synthesis [Kwatra07 sec. III]. The program, the benchmarks and whoever links the
// library take this way.
#pragma once

#include "pipeline/orientation_guide.h"
#include "pipeline/texture_guidance.h"
#include "pipeline/texture_scale.h"
#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "texture/frames/synthesize.h"
#include "texture/orientation/orient.h"
#include "texture/surface.h"

#include <functional>
#include <optional>
#include <vector>

namespace fluidtex::pipeline {

// What all frames of a run share. The exemplar's search tables are made when a frame first asks for them and
// kept here.
struct Texturing {
  scenes::Scene scene;
  texture::Synthesizer synthesizer;
  OrientationGuide orientation;
  TextureScale scale;
  TextureGuidance guidance;
};

// Reads what the scene's settings name: exemplar, maps, vector and scalar fields. cache: where search tables
// are kept from run to run. Throws ExemplarError, or std::runtime_error that names a field's file.
Texturing makeTexturing(const scenes::Scene& scene, const texture::CacheFolder& cache = {});
// The same with an exemplar from memory, prepared for scene.texture.surface.levels levels.
Texturing makeTexturing(const scenes::Scene& scene, texture::Exemplar exemplar,
                        const texture::CacheFolder& cache = {});

enum class Stage { prepare, transport, synthesize };

// Who is told how a frame gets on, and by which clock its stages are timed.
struct Watch {
  std::function<void(Stage, double part)> progress{};  // part: 0 to 1; what it throws ends the frame
  std::function<double()> seconds{};                   // empty: wall time
};

struct FrameSeconds {
  double prepare = 0.0, transport = 0.0, synthesize = 0.0;
};

struct TexturedFrame {
  // Its spacing is set as soon as there is a surface, and kept while there is none.
  texture::TexturedSurface surface;
  texture::SynthesisStats synthesis;
  std::optional<std::vector<texture::Singularity>> singularities;  // not known without a surface
  bool foreseenSpacing = false;  // chosen in this frame, for the surface that the liquid is going to have
  FrameSeconds seconds;
};

// last: the textured surface of the frame before, empty for the first one; its spacing, where it has one, is
// kept, else it is scene.texture.spacing, or made of scene.texture.points. frame.substeps lead from there to
// here. Same input, same bytes, on any number of threads. Throws as prepareSurface(), carry(), orient() and
// synthesize() do.
TexturedFrame textureFrame(Texturing& texturing, const texture::TexturedSurface& last,
                           const sim::Frame& frame, const Watch& watch = {});

}  // namespace fluidtex::pipeline
