// Transport [Kwatra07 sec. VI]: brings the texture of the last frame's surface onto a new one.
#pragma once

#include "sim/frame/frame.h"
#include "texture/surface.h"
#include "transport/options.h"

#include <array>

namespace fluidtex::transport {

// The points of the last surface moved forward with the flow over all substeps: seeds for the next surface.
std::vector<texture::Vec3f> moved(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame);

// Velocity at world positions at the end of the frame (last substep), m/s; zero where no velocity is known.
std::vector<texture::Vec3f> velocityAt(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame);

// How that velocity changes there, 1/s, by differences over two of the solver's cells, or over one where
// velocity is known to one side only: [axis][v] is d(velocity) / d(axis). Zero where it is not known, or
// nothing has moved yet.
std::array<std::vector<texture::Vec3f>, 3> velocitySlopes(const std::vector<texture::Vec3f>& positions,
                                                          const sim::Frame& frame);

// 1 where a position is nearer to a solid than half a voxel, else 0.
std::vector<std::uint8_t> contactAt(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame);

// Each vertex of `next` is traced back through the frame, together with the gradient of that map, by
// options.method; lands on the closest point of `previous`; and picks up what is there:
//  - exemplar coordinate: the nearest corner's plus its gradient times the offset, never averaged across
//    jumps; its gradient deformed by the flow; likewise the place that fades;
//  - colour, age and foam by barycentric interpolation;
//  - orientation, by a cubic between the corners, turned with the flow by equation (4), or not (see
//    options.orientation), tangent to the new surface; directions that turns of 360 / symmetry degrees make
//    equal are interpolated as one. With Method::grid it goes over the grid instead, as an arrow: symmetry 1.
// trust: transport/trust.h, times the share of the path along which the velocity is known; no more than that
// of stretch. previous empty (the first frame with a surface): an empty result. Throws std::invalid_argument
// where an array of the old surface has not one entry per vertex, or the new mesh no normals.
texture::Carried carry(const texture::TexturedSurface& previous, const sim::Frame& frame,
                       const texture::SurfaceMesh& next, int symmetry = 1, const Options& options = {});

}  // namespace fluidtex::transport
