// The surface as it will be a while from now: texture that is laid for it is compressed where the flow draws
// it out, and lasts up to twice as long before it is stretched too much.
#pragma once

#include "texture/labels/labels.h"

#include <vector>

namespace fluidtex::texture {

// A symmetric 2x2 matrix in a vertex's axes: `mean` times one plus [[a, b], [b, -a]], deviator = a + i b.
struct Strain {
  float mean = 0.0f;
  Complexf deviator{0.0f, 0.0f};
};

// exp(strain) x.
Complexf strained(const Strain& strain, const Complexf& x);

// #V, 1/s, logarithmic: how the surface around each vertex was strained in the last `seconds`. Fitted to how
// the lengths of the vertex's edges changed since `previous` (where the vertices were) and averaged over a
// small window; where trust is low it is that of the surroundings. Zero where seconds are.
std::vector<Strain> strainRates(const MeshView& view, const std::vector<Vec3f>& previous,
                                const std::vector<float>& trust, double seconds);

// Its largest eigenvalue, up to the sign.
float largest(const Strain& strain);

// #V: how the surface will be strained in `horizon` seconds if it goes on so, no eigenvalue beyond `most`.
std::vector<Strain> strainAhead(std::vector<Strain> rates, double horizon, double most);

// The view's edges strained, each by the mean of its ends.
Connection strained(const MeshView& view, const std::vector<Strain>& strain);

// The labels as the strained surface has them, and back.
Labels strained(Labels labels, const std::vector<Strain>& strain);
Labels unstrained(Labels labels, const std::vector<Strain>& strain);

}  // namespace fluidtex::texture
