// Colour profiles for the tests, made by the library that reads them.
#pragma once

#include <lcms2.h>

#include <array>
#include <memory>
#include <vector>

using Bytes = std::vector<unsigned char>;

inline Bytes savedProfile(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  Bytes bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

// RGB with these primaries, sRGB's white and one curve of a power for all (1: straight; 0: sRGB's own).
inline Bytes rgbProfile(const cmsCIExyYTRIPLE& primaries, double gamma) {
  const cmsCIExyY white{0.3127, 0.3290, 1.0};
  cmsFloat64Number srgb[5] = {2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045};
  cmsToneCurve* curve =
      gamma > 0.0 ? cmsBuildGamma(nullptr, gamma) : cmsBuildParametricToneCurve(nullptr, 4, srgb);
  cmsToneCurve* curves[3] = {curve, curve, curve};
  const Bytes bytes = savedProfile(cmsCreateRGBProfile(&white, &primaries, curves));
  cmsFreeToneCurve(curve);
  return bytes;
}

constexpr cmsCIExyYTRIPLE kSrgbPrimaries = {{0.64, 0.33, 1.0}, {0.30, 0.60, 1.0}, {0.15, 0.06, 1.0}};
constexpr cmsCIExyYTRIPLE kP3Primaries = {{0.680, 0.320, 1.0}, {0.265, 0.690, 1.0}, {0.150, 0.060, 1.0}};

// From linear light of Display P3's primaries to that of sRGB's, same white: rows.
constexpr double kP3ToSrgb[3][3] = {
    {1.2249, -0.2247, 0.0}, {-0.0420, 1.0419, 0.0}, {-0.0197, -0.0786, 1.0979}};

inline Bytes greyProfile(double gamma) {
  const cmsCIExyY* white = cmsD50_xyY();
  cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
  const Bytes bytes = savedProfile(cmsCreateGrayProfile(white, curve));
  cmsFreeToneCurve(curve);
  return bytes;
}

// Inks of which only black darkens, straight in lightness: L = 100 (1 - K).
inline Bytes inkProfile() {
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(profile, 2.4);
  cmsSetDeviceClass(profile, cmsSigOutputClass);
  cmsSetColorSpace(profile, cmsSigCmykData);
  cmsSetPCS(profile, cmsSigLabData);
  cmsPipeline* table = cmsPipelineAlloc(nullptr, 4, 3);
  cmsStage* grid = cmsStageAllocCLut16bit(nullptr, 2, 4, 3, nullptr);
  cmsStageSampleCLut16bit(
      grid,
      [](const cmsUInt16Number* in, cmsUInt16Number* out, void*) -> cmsInt32Number {
        out[0] = cmsUInt16Number(0xff00 - 0xff00ll * in[3] / 0xffff);  // of version 2's Lab
        out[1] = out[2] = 0x8000;
        return 1;
      },
      nullptr, 0);
  // A table of 16 bits has curves before and behind it.
  cmsPipelineInsertStage(table, cmsAT_END, cmsStageAllocToneCurves(nullptr, 4, nullptr));
  cmsPipelineInsertStage(table, cmsAT_END, grid);
  cmsPipelineInsertStage(table, cmsAT_END, cmsStageAllocToneCurves(nullptr, 3, nullptr));
  for (const cmsTagSignature tag : {cmsSigAToB0Tag, cmsSigAToB1Tag}) cmsWriteTag(profile, tag, table);
  cmsPipelineFree(table);
  const cmsCIEXYZ* white = cmsD50_XYZ();
  cmsWriteTag(profile, cmsSigMediaWhitePointTag, white);
  return savedProfile(profile);
}
