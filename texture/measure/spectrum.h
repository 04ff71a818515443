// Radial power spectra of pictures.
#pragma once

#include "texture/measure/tiles.h"

#include <vector>

namespace fluidtex::texture {

// Mean over the pictures (square) of the power of their first channel, less its mean and under a Hann window,
// by whole cycles a picture: entry k - 1 is the mean over all frequencies (p, q) whose length rounds to k, k
// = 1 to half the picture's size.
std::vector<double> radialSpectrum(const Stack& pictures);

// rms difference of two spectra, dB (10 log10), over frequencies where either exceeds the floor, 1e-6 of the
// largest power in both; lower powers are raised to the floor. 0 if there is no such frequency.
double spectrumDistance(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace fluidtex::texture
