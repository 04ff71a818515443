// The triangles of a picture in an acceleration structure, and rays against it.
#pragma once

#include "render/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace fluidtex::render {

inline constexpr std::uint32_t kNothing = 0xffffffffu;

// A ray and, after intersect(), what it met first.
struct Ray {
  Vec3f origin, direction;
  std::uint32_t geometry = kNothing;  // in the order of addition, or kNothing
  std::uint32_t triangle = kNothing;
  float u = 0.0f, v = 0.0f;  // barycentric weights of the triangle's second and third corner

  bool hit() const { return geometry != kNothing; }
};

// Neighbouring rays that take much the same way are traced together; others one by one.
enum class Coherence { alike, scattered };

class EmbreeScene {
 public:
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Copies a mesh in and returns its number. Throws std::runtime_error if memory runs out.
  std::uint32_t add(const std::vector<Vec3f>& positions, const std::vector<texture::Vec3I>& triangles);

  // Builds, on all threads; to be called once after the last add(). The structure does not depend on their
  // number.
  void commit();

  // Finds the first hit of every ray.
  void intersect(std::span<Ray> rays, Coherence coherence) const;

  // blocked[i] = 1 if anything lies on ray i, else 0. The rays' hits are left as they are.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked, Coherence coherence) const;

 private:
  struct Handles;
  std::unique_ptr<Handles> m_handles;
};

}  // namespace fluidtex::render
