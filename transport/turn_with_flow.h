// Directions turned by the flow: equation (4) of [Kwatra07 sec. VI] along a path.
#pragma once

#include "texture/surface.h"

#include <openvdb/math/Mat3.h>

namespace fluidtex::transport {

using openvdb::Mat3d;
using texture::Vec3f;

// Some unit vector normal to n.
Vec3f anyTangent(const Vec3f& n);

// A direction d of the old surface on the new one. Equation (4) is  D d/Dt = (I - d d^T) A d,  A = grad u.
// With D l/Dt = A l and d = l/|l| it follows at once, and l is carried by the gradient of the flow: l_new =
// (d x_new / d x_old) l_old = B^-1 l_old. So the whole frame's turn is one product with the matrix that the
// trace brings along, exact for the traced map, and |d| = 1 by normalising. What is tangent stays tangent up
// to the difference of the two meshes, which the projection onto the plane of `normal` removes. map: B, where
// a place of the new surface was, differentiated by where it is.
Vec3f turnedWithFlow(const Vec3f& d, const Mat3d& map, const Vec3f& normal);

// The old surface's normal where the new one's is `normal`. A normal is a gradient, grad phi_new = grad
// phi_old B; so the old one is B^-T of the new one, = (adj B)^T up to a factor.
Vec3f carriedNormal(const Vec3f& normal, const Mat3d& map);

}  // namespace fluidtex::transport
