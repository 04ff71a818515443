// Transport [Kwatra07 sec. VI]: the last frame's texture, brought onto a new surface.
#pragma once

#include "sim/frame/frame.h"
#include "texture/surface.h"
#include "transport/options.h"

#include <array>

namespace fluidtex::transport {

// Points of the last surface (metres), advected over all substeps: seeds for the next surface.
std::vector<texture::Vec3f> moved(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame);

// Velocity at world positions at the end of the frame (last substep), m/s; zero where unknown.
std::vector<texture::Vec3f> velocityAt(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame);

// Gradient of that velocity, 1/s: [axis][v] is d(velocity) / d(axis). Differences over two of the solver's
// cells, or over one where velocity is known to one side only. Zero where unknown, or without substeps.
std::array<std::vector<texture::Vec3f>, 3> velocitySlopes(const std::vector<texture::Vec3f>& positions,
                                                          const sim::Frame& frame);

// #V, 1 where a position is closer to a solid than half a voxel.
std::vector<std::uint8_t> contactAt(const std::vector<texture::Vec3f>& positions, const sim::Frame& frame);

// Traces each vertex of `next` back through the frame, together with the gradient of that map, by
// options.method; projects it onto the closest point of `previous`; and picks up the values there:
//  - exemplar coordinate: the nearest corner's plus its gradient times the offset, never averaged across a
//    seam; its gradient deformed by the flow; likewise the former coordinate of a cross-fade;
//  - colour, age, foam and rest positions: barycentric;
//  - whether the texture is original: the nearest corner's;
//  - orientation: cubic between the corners, turned with the flow by equation (4) or, as options.orientation
//    says, not; tangent to the new surface. Directions equal under rotations by 360 / symmetry degrees are
//    interpolated as one. With Method::grid it is advected on the grid as a vector, symmetry 1.
// Where the flow goes through a surface that stays (Carried::stays), the values are those at the vertex
// itself. At inflow along the surface, orientation and exemplar coordinates are extrapolated
// (transport/inflow.h). trust: the smaller of stretchTrust() and the product of landingTrust(),
// neighborTrust() and the share of the path along which the velocity is known. `previous` empty (the first
// frame with a surface): empty result. Throws std::invalid_argument if an array of the old surface does not
// have one entry per vertex, the new mesh has no normals, symmetry is below 1, or VelocitySampler or, with
// Method::grid, bandOf() refuses the velocity grids.
texture::Carried carry(const texture::TexturedSurface& previous, const sim::Frame& frame,
                       const texture::SurfaceMesh& next, int symmetry = 1, const Options& options = {});

}  // namespace fluidtex::transport
