// A narrow-band level set in small padded blocks, so that a tricubic sample is one gather of 4x4x4 values;
// and the scale of the texture on it.
#pragma once

#include "numerics/block_table.h"
#include "texture/surface.h"

#include <openvdb/openvdb.h>

#include <memory>

namespace fluidtex::texture {

inline constexpr int kBlockSide = 8;     // cells along a block's edge; block origins are multiples of it
inline constexpr int kBlockPadded = 11;  // values along its edge: local coordinates -1..9
static_assert(BlockTable::kNone == kNone);

// Index space (voxel = 1, voxel centres at integers); distances in voxels, whatever the grid's transform.
// Only blocks near the zero set are kept. Throws std::invalid_argument if a value is not finite or voxels are
// not cubes.
class LevelSet {
 public:
  explicit LevelSet(const openvdb::FloatGrid& phi);

  // Blocks with a cell that the zero set crosses come first, along a space-filling curve, then their
  // surroundings.
  std::size_t surfaceBlockCount() const { return m_surfaceBlocks; }
  const openvdb::Coord& origin(std::size_t block) const { return m_origins[block]; }
  // Values at local coordinates (x, y, z) of a block, each -1..9: values(b)[((x + 1) * kBlockPadded + y + 1)
  // * kBlockPadded + z + 1].
  const float* values(std::size_t block) const {
    return m_values.get() + block * kBlockPadded * kBlockPadded * kBlockPadded;
  }
  std::size_t blockCount() const { return m_origins.size(); }
  // kNone where the block is not kept.
  std::uint32_t find(const openvdb::Coord& origin) const { return m_blocks.find(origin); }

  // Side of an exemplar pixel at x over the spacing; linear between voxels. 1 before setScale().
  float scale(const Vec3f& x) const { return m_scale.empty() ? 1.0f : sampleScale(x); }
  bool scaled() const { return !m_scale.empty(); }
  // kScaled^3 values per block, at local coordinates 0..8, x slowest.
  static constexpr int kScaled = kBlockSide + 1;
  void setScale(std::vector<float> values) { m_scale = std::move(values); }

  struct Sample {
    float value = 0.0f;    // voxels, negative inside
    Vec3f gradient{0.0f};  // of the same interpolant; zero where unknown
    bool known = false;
  };
  // Catmull-Rom interpolation along each axis: value and gradient are continuous.
  Sample sample(const Vec3f& x) const;

  struct Projection {
    Vec3f position;
    Vec3f normal{0.0f};     // unit, outward; zero where the gradient vanishes
    float distance = 0.0f;  // residual |value|, voxels
    bool known = false;
  };
  // Projects to the zero set by Newton steps along the gradient, at most `reach` voxels from x.
  Projection project(const Vec3f& x, float reach = 1.0f) const;
  // One Newton step, for points close to the zero set: the residual is of second order. `distance` is not
  // set.
  Projection slide(const Vec3f& x, float reach = 1.0f) const;

 private:
  float sampleScale(const Vec3f& x) const;

  std::vector<openvdb::Coord> m_origins;
  std::unique_ptr<float[]> m_values;
  std::vector<float> m_scale;  // empty: 1 everywhere
  BlockTable m_blocks;
  std::size_t m_surfaceBlocks = 0;
};

}  // namespace fluidtex::texture
