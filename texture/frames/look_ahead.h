// Look-ahead: texture is laid for the surface as the flow will have strained it. Where the flow stretches,
// new texture is laid compressed, and lasts up to twice as long until it is stretched too much.
#pragma once

#include "texture/labels/labels.h"

#include <vector>

namespace fluidtex::texture {

// Logarithmic strain, a symmetric 2x2 matrix in a vertex's axes: mean I + [[a, b], [b, -a]] with deviator = a
// + i b.
struct Strain {
  float mean = 0.0f;
  Complexf deviator{0.0f, 0.0f};
};

// exp(strain) x.
Complexf strained(const Strain& strain, const Complexf& x);

// #V: logarithmic strain rate of the surface, 1/s, over the last `seconds`. Fitted to the change of edge
// lengths since `previous` (#V, former positions) and averaged over a small window; where trust (#V) is low
// it is that of the surroundings. Zero if `seconds` is zero.
std::vector<Strain> strainRates(const MeshView& view, const std::vector<Vec3f>& previous,
                                const std::vector<float>& trust, double seconds);

// Largest absolute eigenvalue.
float largest(const Strain& strain);

// #V: strain after `horizon` seconds at constant rates, scaled so that no absolute eigenvalue exceeds `most`.
std::vector<Strain> strainAhead(std::vector<Strain> rates, double horizon, double most);

// The view's connection with strained edges, each by the mean strain of its ends.
Connection strained(const MeshView& view, const std::vector<Strain>& strain);

// Labels in pixels of the strained surface, and the inverse.
Labels strained(Labels labels, const std::vector<Strain>& strain);
Labels unstrained(Labels labels, const std::vector<Strain>& strain);

}  // namespace fluidtex::texture
