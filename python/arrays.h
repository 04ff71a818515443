// NumPy arrays to and from the values that textureFrame() takes and gives. Each function throws
// std::invalid_argument with one sentence that begins with the argument's name.
#pragma once

#include "caches/liquid/surface_mesh.h"
#include "texture/exemplar/image.h"
#include "texture/surface.h"

#include <openvdb/openvdb.h>
#include <pybind11/numpy.h>

#include <optional>
#include <string>
#include <vector>

namespace fluidtex::python {

namespace py = pybind11;
using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

// An array of numbers of that many dimensions; the last one has `last` entries, unless that is 0.
Floats floats(const py::handle& value, const std::string& name, int dimensions, py::ssize_t last = 0);

// nx x ny x nz values, or vectors, at origin + voxel (i, j, k). The liquid may not reach the outer faces.
openvdb::FloatGrid::Ptr levelSet(const py::handle& phi, const openvdb::Vec3d& origin, double voxel);
// likePhi: whose size it must have.
openvdb::Vec3SGrid::Ptr velocityGrid(const py::handle& velocity, const py::handle& likePhi,
                                     const openvdb::Vec3d& origin, double voxel);

// Values at the same places, by any name.
openvdb::FloatGrid::Ptr scalarGrid(const py::handle& values, const std::string& name,
                                   const py::handle& likePhi, const openvdb::Vec3d& origin, double voxel);

std::vector<openvdb::Vec3f> vectors(const py::handle& value, const std::string& name);
std::vector<openvdb::Vec3I> triangles(const py::handle& value, std::size_t points);

// height x width x 3 or 4, or height x width: bytes are sRGB, floats linear.
texture::Image picture(const py::handle& value);

// The arrays of a surface, by name. toroidal: coordinates are brought onto the exemplar, in this way;
// nothing: they stay as they are.
py::dict arraysOf(const texture::TexturedSurface& surface, std::optional<bool> toroidal);

}  // namespace fluidtex::python
