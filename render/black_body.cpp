// The observer: Wyman, Sloan and Shirley, Simple analytic approximations to the CIE XYZ color matching
// functions, JCGT 2013, multi-lobe fit.
#include "render/black_body.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::render {
namespace {

// A bell that falls off by another width on either side of its peak, nanometres.
double bell(double wavelength, double peak, double below, double above) {
  const double t = (wavelength - peak) / (wavelength < peak ? below : above);
  return std::exp(-0.5 * t * t);
}

struct Observer {
  double x, y, z;
};

Observer observer(double nm) {
  return {1.056 * bell(nm, 599.8, 37.9, 31.0) + 0.362 * bell(nm, 442.0, 16.0, 26.7) -
              0.065 * bell(nm, 501.1, 20.4, 26.2),
          0.821 * bell(nm, 568.8, 46.9, 40.5) + 0.286 * bell(nm, 530.9, 16.3, 31.1),
          1.217 * bell(nm, 437.0, 11.8, 36.0) + 0.681 * bell(nm, 459.0, 26.0, 13.8)};
}

// Planck's law without its constant factors, per wavelength.
double planck(double nm, double kelvin) {
  constexpr double kSecond = 1.438777e7;  // h c / k, nm K
  const double micrometres = nm * 1e-3;
  return std::pow(micrometres, -5.0) / std::expm1(kSecond / (nm * kelvin));
}

}  // namespace

Vec3f blackBody(double kelvin) {
  double x = 0.0, y = 0.0, z = 0.0;
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) {
    const Observer seen = observer(nm);
    const double light = planck(nm, kelvin);
    x += seen.x * light;
    y += seen.y * light;
    z += seen.z * light;
  }
  const double rgb[3] = {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
                         0.0557 * x - 0.2040 * y + 1.0570 * z};
  Vec3f color;
  for (int k = 0; k < 3; ++k) color[k] = static_cast<float>(std::max(0.0, rgb[k]));
  return color;
}

}  // namespace fluidtex::render
