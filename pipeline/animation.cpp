#include "pipeline/animation.h"

#include "texture/exemplar/read_image.h"
#include "texture/shown/maps.h"
#include "texture/shown/sequence.h"

#include <utility>

namespace fluidtex::pipeline {

Animation::Animation(texture::AnimationOptions options, bool toroidal)
    : m_options(std::move(options)), m_toroidal(toroidal), m_pictures(m_options.files.size()) {
  if (!byGuidance()) return;
  for (std::size_t n = 0; n < m_pictures.size(); ++n) picture(n);
}

const texture::Image& Animation::picture(std::size_t n) {
  if (m_pictures[n].data.empty()) m_pictures[n] = texture::readImage(m_options.files[n]);
  return m_pictures[n];
}

std::optional<texture::Image> Animation::pictureAt(double seconds) {
  if (!moves() || byGuidance()) return std::nullopt;
  const auto [first, second, share] = texture::picturesAt(m_options, m_pictures.size(), seconds);
  for (std::size_t n = 0; n < m_pictures.size(); ++n)
    if (n != first && n != second) m_pictures[n] = {};
  const texture::Image& earlier = picture(first);
  return share > 0.0f ? texture::mixed(earlier, picture(second), share) : earlier;
}

void Animation::show(double seconds, const std::vector<float>& guidance, texture::TexturedSurface& surface) {
  if (!moves() || surface.empty()) return;
  if (!byGuidance()) return texture::lookUpColor(*pictureAt(seconds), m_toroidal, surface);
  std::vector<texture::ShownPictures> shown;
  shown.reserve(guidance.size());
  for (const float level : guidance) shown.push_back(texture::picturesFor(m_pictures.size(), level));
  texture::lookUpColors(m_pictures, shown, m_toroidal, surface);
}

}  // namespace fluidtex::pipeline
