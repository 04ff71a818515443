// The sequence of pictures of an exemplar that moves.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <optional>
#include <vector>

namespace fluidtex::pipeline {

// Where time chooses the picture, pictures are read when they are shown, and two stay in memory; where
// guidance chooses, all are in memory, 16 bytes a pixel. Members throw ExemplarError of a file that cannot be
// read, and std::invalid_argument of pictures of different sizes.
class Animation {
 public:
  // Of one picture that stays, or of none.
  Animation() = default;
  Animation(texture::AnimationOptions options, bool toroidal);

  bool moves() const { return !m_options.files.empty(); }
  bool byGuidance() const { return moves() && m_options.by == texture::ShowBy::guidance; }

  // What time chooses, the same for all places: linear RGBA, straight alpha. Nothing where the exemplar does
  // not move or guidance chooses.
  std::optional<texture::Image> pictureAt(double seconds);

  // Sets the colours of a frame at this time; none change where the exemplar does not move. guidance: #V
  // levels, where guidance chooses.
  void show(double seconds, const std::vector<float>& guidance, texture::TexturedSurface& surface);

 private:
  const texture::Image& picture(std::size_t n);

  texture::AnimationOptions m_options;
  bool m_toroidal = false;
  std::vector<texture::Image> m_pictures;  // empty ones are not in memory
};

}  // namespace fluidtex::pipeline
