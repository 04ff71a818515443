// Validation across several keys of a scene.
#pragma once

#include "scenes/reader.h"
#include "scenes/scene.h"

namespace fluidtex::scenes {

// Adds a fault for each invalid combination. Keys that have a fault already are skipped.
void check(const Scene& scene, Reader& reader);

// False for a liquid out of files in a scene without a domain.
inline bool isSizeKnown(const Scene& scene) {
  return scene.sim.size[0] > 0.0;
}

inline constexpr const char* kAxes[] = {"x", "y", "z"};

// Its parts: a shape, and files that are one shape after the other, at `path`; domain, bodies, flows, heat;
// the texture on them.
void checkShape(const sim::Shape& shape, const std::string& path, Reader& reader);
void checkSequence(const sim::MeshSequence& sequence, const std::string& path, Reader& reader);
void checkLiquid(const Scene& scene, Reader& reader);
void checkTexture(const Scene& scene, Reader& reader);

}  // namespace fluidtex::scenes
