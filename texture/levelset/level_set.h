// A narrow-band level set copied into small padded blocks, so that a tricubic sample is one gather of 4x4x4
// values; and how large an exemplar's pixel should be beside it.
#pragma once

#include "texture/surface.h"

#include <openvdb/openvdb.h>

#include <memory>

namespace fluidtex::texture {

// Works in index space (one voxel = 1, voxel centres at integers) and in voxels of distance, whatever the
// grid's transform. Only blocks near the zero set are kept. Throws std::invalid_argument if a value is not
// finite or voxels are not cubes.
class LevelSet {
 public:
  static constexpr int kSide = 8;     // cells along a block's edge; block origins are multiples of it
  static constexpr int kPadded = 11;  // values along its edge: local coordinates -1..9
  static constexpr std::uint32_t kNone = ~std::uint32_t(0);

  explicit LevelSet(const openvdb::FloatGrid& phi);

  // Blocks that hold a cell which the zero set crosses come first, along a space-filling curve; then their
  // surroundings.
  std::size_t surfaceBlockCount() const { return m_surfaceBlocks; }
  const openvdb::Coord& origin(std::size_t block) const { return m_origins[block]; }
  // Values at local coordinates (x, y, z) of a block, each -1..9: values(b)[((x + 1) * kPadded + y + 1) *
  // kPadded + z + 1].
  const float* values(std::size_t block) const {
    return m_values.get() + block * kPadded * kPadded * kPadded;
  }
  std::size_t blockCount() const { return m_origins.size(); }
  std::uint32_t find(const openvdb::Coord& origin) const;

  // The side of an exemplar's pixel at x, as a multiple of the spacing; 1 everywhere until setScale() is
  // called. Linear between voxels.
  float scale(const Vec3f& x) const { return m_scale.empty() ? 1.0f : sampleScale(x); }
  bool scaled() const { return !m_scale.empty(); }
  // kScaled^3 values for each of the blocks, at local coordinates 0..8, x slowest.
  static constexpr int kScaled = kSide + 1;
  void setScale(std::vector<float> values) { m_scale = std::move(values); }

  struct Sample {
    float value = 0.0f;    // voxels, negative inside
    Vec3f gradient{0.0f};  // of the same interpolant; zero where the level set is not known
    bool known = false;
  };
  // Catmull-Rom interpolation in each direction: value and gradient are continuous.
  Sample sample(const Vec3f& x) const;

  struct Projection {
    Vec3f position;
    Vec3f normal{0.0f};     // unit, outward; zero where the gradient vanishes
    float distance = 0.0f;  // |value| that is left, voxels
    bool known = false;
  };
  // Newton steps along the gradient to the zero set, at most `reach` voxels from x.
  Projection project(const Vec3f& x, float reach = 1.0f) const;
  // One Newton step, for a point that has left the zero set by a little only: what it leaves is of the second
  // order. `distance` is not filled in.
  Projection slide(const Vec3f& x, float reach = 1.0f) const;

 private:
  float sampleScale(const Vec3f& x) const;

  std::vector<openvdb::Coord> m_origins;
  std::unique_ptr<float[]> m_values;
  std::vector<float> m_scale;          // empty: 1 everywhere
  std::vector<std::uint32_t> m_table;  // open addressing on the block's origin
  std::size_t m_surfaceBlocks = 0;
};

}  // namespace fluidtex::texture
