// Acceleration structure for the triangles of a picture.
#pragma once

#include "render/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace fluidtex::render {

inline constexpr std::uint32_t kNothing = 0xffffffffu;

// A ray and, after intersect(), its first hit.
struct Ray {
  Vec3f origin, direction;
  std::uint32_t geometry = kNothing;  // in the order of addition, or kNothing
  std::uint32_t triangle = kNothing;
  float u = 0.0f, v = 0.0f;  // barycentric weights of the triangle's second and third corner
  float time = 0.0f;         // 0..1, of the way that moving meshes go

  bool hit() const { return geometry != kNothing; }
};

// Coherent rays are traced in packets, others one by one.
enum class Coherence { alike, scattered };

class EmbreeScene {
 public:
  EmbreeScene();
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  // Copies a mesh and returns its geometry number. Throws std::bad_alloc if memory runs out, and
  // std::runtime_error for other errors of Embree; so do the constructor and commit().
  std::uint32_t add(const std::vector<Vec3f>& positions, const std::vector<texture::Vec3I>& triangles);

  // The same of a mesh whose vertices go straight from one place, at time 0, to another, at time 1.
  std::uint32_t addMoving(const std::vector<Vec3f>& from, const std::vector<Vec3f>& to,
                          const std::vector<texture::Vec3I>& triangles);

  // Builds the structure, on all threads; to be called once after the last add(). The result does not depend
  // on the number of threads.
  void commit();

  // Finds the first hit of every ray.
  void intersect(std::span<Ray> rays, Coherence coherence) const;

  // blocked[i] = 1 if anything lies on ray i, else 0. Hits are not recorded.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked, Coherence coherence) const;

 private:
  struct Handles;
  std::uint32_t addMoments(std::span<const std::vector<Vec3f>* const> moments,
                           const std::vector<texture::Vec3I>& triangles);
  std::unique_ptr<Handles> m_handles;
};

}  // namespace fluidtex::render
