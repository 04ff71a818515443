// How often each part of the exemplar is used, so that all of it keeps its share [Kaspar15].
#pragma once

#include "texture/exemplar/texel_image.h"
#include "texture/labels/guidance.h"

#include <vector>

namespace fluidtex::texture {

// Places in the exemplar, counted in a grid of cells and spread linearly over the four nearest.
class Usage {
 public:
  // Square cells of about `cell` texels; `count` places will be counted in all. Where parts are asked for
  // unevenly, each should be used as much as it is asked for.
  Usage(const TexelImage& image, int cell, std::size_t count, const Demand& demand = {});

  void add(const Vec2f& texel, float amount);

  // 1 where this part is used as often as it should be, 2 where twice as often.
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
