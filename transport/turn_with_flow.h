// Rotation of directions by the flow: equation (4) of [Kwatra07 sec. VI] along a path.
#pragma once

#include "texture/surface.h"

#include <openvdb/math/Mat3.h>

namespace fluidtex::transport {

using openvdb::Mat3d;
using texture::Vec3f;

// Some unit vector normal to n.
Vec3f anyTangent(const Vec3f& n);

// A direction d of the old surface on the new one. Equation (4) is  D d/Dt = (I - d d^T) A d,  A = grad u. It
// follows from D l/Dt = A l with d = l/|l|, and l is advected by the deformation gradient: l_new = (d x_new /
// d x_old) l_old = B^-1 l_old. So the rotation of a whole frame is one product with the inverse of the traced
// B, exact for the traced map, then normalised. Tangents stay tangent up to the difference of the two meshes,
// which the projection to the plane of `normal` removes. map: B = d x_old / d x_new.
Vec3f turnedWithFlow(const Vec3f& d, const Mat3d& map, const Vec3f& normal);

// The old surface's normal where the new one's is `normal`. A normal is a gradient, grad phi_new = grad
// phi_old B, so the old one is B^-T of the new one, = (adj B)^T up to a factor.
Vec3f carriedNormal(const Vec3f& normal, const Mat3d& map);

}  // namespace fluidtex::transport
