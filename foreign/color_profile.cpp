#include "foreign/color_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace fluidtex::foreign {
namespace {

// Steps of a curve's table: each of 255 levels lies on one.
constexpr int kSteps = 255 * 16;

cmsUInt32Number formatOf(int channels) {
  return channels == 1 ? TYPE_GRAY_FLT : channels == 3 ? TYPE_RGB_FLT : TYPE_CMYK_FLT;
}

std::shared_ptr<void> rgbOf(const cmsCIExyY& white, const cmsCIExyYTRIPLE& primaries, bool isEncoded) {
  // sRGB's curve: a power above 0.04045, a line below.
  const double srgb[5] = {2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045};
  const std::shared_ptr<cmsToneCurve> curve(
      isEncoded ? cmsBuildParametricToneCurve(nullptr, 4, srgb) : cmsBuildGamma(nullptr, 1.0),
      cmsFreeToneCurve);
  cmsToneCurve* curves[3] = {curve.get(), curve.get(), curve.get()};
  return {cmsCreateRGBProfile(&white, &primaries, curves), cmsCloseProfile};
}

std::shared_ptr<void> linearSrgb() {
  return rgbOf({0.3127, 0.3290, 1.0}, {{0.64, 0.33, 1.0}, {0.30, 0.60, 1.0}, {0.15, 0.06, 1.0}}, false);
}

double encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

// Places all over the cube, none on its axes.
std::vector<float> places(int channels) {
  std::vector<float> result;
  for (int i = 0; i < 512; ++i)
    for (int c = 0; c < channels; ++c) {
      const double step[3] = {0.8191725134, 0.6710436067, 0.5497004779};  // no pattern in three dimensions
      result.push_back(float(std::fmod((i + 0.5) * step[c], 1.0)));
    }
  return result;
}

}  // namespace

int profileChannels(std::span<const unsigned char> icc) {
  if (icc.size() < 128) return 0;
  const auto is = [&](const char* space) { return std::memcmp(icc.data() + 16, space, 4) == 0; };
  return is("GRAY") ? 1 : is("RGB ") ? 3 : is("CMYK") ? 4 : 0;
}

ColorProfile::ColorProfile(std::span<const unsigned char> icc, int channels) : m_channels(channels) {
  const int own = profileChannels(icc);
  if (own != 0 && own != channels)
    throw Unreadable(std::string("is for ") +
                     (own == 1   ? "grey"
                      : own == 3 ? "RGB"
                                 : "CMYK") +
                     ", and the picture is not");
  const std::shared_ptr<void> profile(
      own == 0 ? nullptr : cmsOpenProfileFromMem(icc.data(), cmsUInt32Number(icc.size())),
      [](void* p) { p != nullptr&& cmsCloseProfile(p); });
  if (!profile) throw Unreadable("is damaged or of no kind that can be used");
  become(profile.get());
}

ColorProfile::ColorProfile(std::span<const float, 8> xy, bool isEncoded) {
  const auto at = [&](std::size_t i) { return cmsCIExyY{xy[2 * i], xy[2 * i + 1], 1.0}; };
  const std::shared_ptr<void> profile = rgbOf(at(3), {at(0), at(1), at(2)}, isEncoded);
  if (!profile) throw Unreadable("are no primaries of colours");
  become(profile.get());
}

void ColorProfile::become(void* profile) {
  // Profiles of inks have darker blacks than light has: black point compensation, as image programs do.
  m_transform = {cmsCreateTransform(profile, formatOf(m_channels), linearSrgb().get(), TYPE_RGB_FLT,
                                    INTENT_RELATIVE_COLORIMETRIC,
                                    cmsFLAGS_BLACKPOINTCOMPENSATION | cmsFLAGS_NOCACHE | cmsFLAGS_NOOPTIMIZE),
                 [](void* t) {
                   if (t != nullptr) cmsDeleteTransform(t);
                 }};
  if (!m_transform) throw Unreadable("is damaged or of no kind that can be used");
  if (m_channels > 3) return;
  const std::vector<float> in = places(m_channels);
  const std::size_t count = in.size() / std::size_t(m_channels);
  std::vector<float> out(3 * count);
  convert(in.data(), count, out.data());
  m_srgb = true;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double wanted = in[i * std::size_t(m_channels) + (m_channels == 3 ? c : 0)];
      m_srgb = m_srgb && std::abs(encoded(out[3 * i + c]) - wanted) < 0.75 / 255.0;
    }
  findCurves();
  // Does the model say what the transform says, there where it was not taken from?
  std::vector<float> modelled(3 * count);
  if (!m_curve[0].empty()) toLinear(in.data(), count, modelled.data());
  for (std::size_t i = 0; i < modelled.size(); ++i)
    if (!(std::abs(modelled[i] - out[i]) < 1e-4f + 2e-3f * std::abs(out[i])))
      for (std::vector<float>& curve : m_curve) curve.clear();
}

void ColorProfile::convert(const float* in, std::size_t pixels, float* out) const {
  // Inks are percents to the library.
  std::vector<float> inks;
  if (m_channels == 4) {
    inks.assign(in, in + 4 * pixels);
    for (float& ink : inks) ink *= 100.0f;
    in = inks.data();
  }
  cmsDoTransform(m_transform.get(), in, out, cmsUInt32Number(pixels));
}

void ColorProfile::findCurves() {
  const auto channels = std::size_t(m_channels);
  for (std::size_t c = 0; c < channels; ++c) {
    std::vector<float> in((kSteps + 1) * channels, 0.0f), out((kSteps + 1) * 3);
    for (std::size_t i = 0; i <= kSteps; ++i) in[i * channels + c] = float(i) / float(kSteps);
    convert(in.data(), kSteps + 1, out.data());
    const float* full = &out[kSteps * 3];
    const auto strongest = std::size_t(
        std::max_element(full, full + 3, [](float a, float b) { return std::abs(a) < std::abs(b); }) - full);
    for (std::size_t row = 0; row < 3; ++row) m_matrix[row][c] = full[row];
    m_curve[c].resize(kSteps + 1);
    for (std::size_t i = 0; i <= kSteps; ++i) m_curve[c][i] = out[3 * i + strongest] / full[strongest];
  }
}

void ColorProfile::toLinear(const float* in, std::size_t pixels, float* out) const {
  const auto channels = std::size_t(m_channels);
  const bool inside = std::all_of(in, in + pixels * channels, [](float v) { return v >= 0.0f && v <= 1.0f; });
  if (m_curve[0].empty() || !inside) return convert(in, pixels, out);
  for (std::size_t i = 0; i < pixels; ++i, in += channels, out += 3) {
    float light[3] = {};
    for (std::size_t c = 0; c < channels; ++c) {
      const float at = in[c] * float(kSteps);
      const int step = std::min(int(at), kSteps - 1);
      const float* value = &m_curve[c][std::size_t(step)];
      light[c] = value[0] + (at - float(step)) * (value[1] - value[0]);
    }
    for (std::size_t row = 0; row < 3; ++row)
      out[row] = m_matrix[row][0] * light[0] + m_matrix[row][1] * light[1] + m_matrix[row][2] * light[2];
  }
}

}  // namespace fluidtex::foreign
