// Usage of each part of the exemplar, for a penalty that keeps its coverage [Kaspar15].
#pragma once

#include "texture/exemplar/texel_image.h"
#include "texture/labels/guidance.h"

#include <vector>

namespace fluidtex::texture {

// A histogram of exemplar coordinates over a grid of cells, each spread bilinearly over four.
class Usage {
 public:
  // cell: side of the square cells, texels, approximately. count: places that will be added in all. demand:
  // expected usage; empty: even.
  Usage(const TexelImage& image, int cell, std::size_t count, const Demand& demand = {});

  void add(const Vec2f& texel, float amount);

  // Usage over its expected value at a texel: 1 as expected, 2 twice as much.
  float at(const Vec2f& texel) const;

 private:
  template <typename Body>
  void visit(const Vec2f& texel, const Body& body) const;
  int brought(int i, int size) const;

  bool m_toroidal;
  int m_columns, m_rows;
  Vec2f m_toCell;
  float m_perMean;
  std::vector<float> m_count, m_asked;  // m_asked: empty without demand
};

}  // namespace fluidtex::texture
