#include "python/arrays.h"

#include "texture/exemplar/srgb.h"
#include "texture/joints/places.h"

#include <fmt/core.h>
#include <openvdb/tools/Dense.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace fluidtex::python {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec2f;
using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;
using openvdb::tools::Dense;
using openvdb::tools::LayoutZYX;

static_assert(sizeof(Vec3f) == 3 * sizeof(float) && sizeof(Vec3I) == 3 * sizeof(std::uint32_t));

std::string shapeOf(const py::array& array) {
  std::string text;
  for (py::ssize_t n = 0; n < array.ndim(); ++n)
    text += (n > 0 ? " x " : "") + std::to_string(array.shape(n));
  return array.ndim() == 0 ? "a single number" : text;
}

py::array anyArray(const py::handle& value, const std::string& name) {
  py::array array = py::array::ensure(value);
  // Truth values, whole numbers and floats; no complex ones, texts or objects.
  if (!array || std::string("biuf").find(array.dtype().kind()) == std::string::npos)
    throw std::invalid_argument(fmt::format("{}: is no array of numbers; give a NumPy array", name));
  return array;
}

openvdb::math::Transform::Ptr transformOf(const Vec3d& origin, double voxel) {
  auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  transform->postTranslate(origin);
  return transform;
}

CoordBBox boxOf(const py::array& array) {
  return {Coord(0), Coord(int(array.shape(0)) - 1, int(array.shape(1)) - 1, int(array.shape(2)) - 1)};
}

// All voxels active, in leaves.
template <class Grid, class Value>
typename Grid::Ptr gridOf(const Floats& array, const Value& background, const Vec3d& origin, double voxel) {
  typename Grid::Ptr grid = Grid::create(background);
  grid->setTransform(transformOf(origin, voxel));
  auto* values = reinterpret_cast<Value*>(const_cast<float*>(array.data()));
  Dense<Value, LayoutZYX> dense(boxOf(array), values);
  openvdb::tools::copyFromDense(dense, *grid, Value(0.0f));
  grid->tree().voxelizeActiveTiles();
  return grid;
}

void checkLike(const py::array& array, const std::string& name, const py::handle& likePhi) {
  const py::array phi = py::array::ensure(likePhi);
  for (int axis = 0; axis < 3; ++axis)
    if (array.shape(axis) != phi.shape(axis))
      throw std::invalid_argument(fmt::format("{}: its shape is {}, phi's {}; give values at the same places",
                                              name, shapeOf(array), shapeOf(phi)));
}

// A copy of columns that lie in memory one row behind the other.
template <class Number, class Row>
py::array_t<Number> columns(const std::vector<Row>& rows, std::vector<py::ssize_t> shape) {
  shape.insert(shape.begin(), py::ssize_t(rows.size()));
  py::array_t<Number> array(shape);
  if (!rows.empty()) std::memcpy(array.mutable_data(), rows.data(), rows.size() * sizeof(Row));
  return array;
}

py::array_t<float> vectorColumns(const std::vector<Vec3f>& rows) {
  return columns<float>(rows, {3});
}

// Texels as 0..1 from the top left corner.
py::array_t<float> places(const std::vector<Vec2f>& texels, const texture::Torus& exemplar, bool brought) {
  py::array_t<float> array({py::ssize_t(texels.size()), py::ssize_t(2)});
  auto out = array.mutable_unchecked<2>();
  for (std::size_t v = 0; v < texels.size(); ++v) {
    const Vec2f texel = brought ? exemplar.brought(texels[v]) : texels[v];
    for (int axis = 0; axis < 2; ++axis)
      out(py::ssize_t(v), axis) = (texel[axis] + 0.5f) / exemplar.size[axis];
  }
  return array;
}

py::array_t<float> slopes(const std::vector<texture::TexelGradient>& gradient, float width, float height) {
  py::array_t<float> array({py::ssize_t(gradient.size()), py::ssize_t(2), py::ssize_t(3)});
  auto out = array.mutable_unchecked<3>();
  for (std::size_t v = 0; v < gradient.size(); ++v)
    for (int axis = 0; axis < 3; ++axis) {
      out(py::ssize_t(v), 0, axis) = gradient[v].s[axis] / width;
      out(py::ssize_t(v), 1, axis) = gradient[v].t[axis] / height;
    }
  return array;
}

}  // namespace

Floats floats(const py::handle& value, const std::string& name, int dimensions, py::ssize_t last) {
  const py::array given = anyArray(value, name);
  if (given.ndim() != dimensions || (last > 0 && given.shape(dimensions - 1) != last))
    throw std::invalid_argument(
        fmt::format("{}: its shape is {}; give {} dimensions{}", name, shapeOf(given), dimensions,
                    last > 0 ? fmt::format(", the last of {}", last) : std::string()));
  Floats array = Floats::ensure(given);
  if (!array) throw std::invalid_argument(name + ": cannot be made floats; give an array of float32");
  const float* numbers = array.data();
  for (py::ssize_t n = 0; n < array.size(); ++n)
    if (!std::isfinite(numbers[n]))
      throw std::invalid_argument(fmt::format("{}: entry {} in memory is not finite; give numbers", name, n));
  return array;
}

openvdb::FloatGrid::Ptr levelSet(const py::handle& phi, const Vec3d& origin, double voxel) {
  const Floats array = floats(phi, "phi", 3);
  const auto value = array.unchecked<3>();
  const py::ssize_t size[3] = {array.shape(0), array.shape(1), array.shape(2)};
  if (array.size() == 0) throw std::invalid_argument("phi: is empty; give values around the surface");
  for (py::ssize_t i = 0; i < size[0]; ++i)
    for (py::ssize_t j = 0; j < size[1]; ++j)
      for (py::ssize_t k = 0; k < size[2]; ++k) {
        const bool edge =
            i == 0 || j == 0 || k == 0 || i == size[0] - 1 || j == size[1] - 1 || k == size[2] - 1;
        if (!edge && k < size[2] - 2) k = size[2] - 2;  // on to the far face
        if (edge && value(i, j, k) < 0.0f)
          throw std::invalid_argument(
              fmt::format("phi: the liquid reaches the array's edge at [{}, {}, {}], where its surface would "
                          "be open; give "
                          "an array with positive values all around, for example numpy.pad(phi, 1, "
                          "constant_values=voxel)",
                          i, j, k));
      }
  return gridOf<openvdb::FloatGrid>(array, std::numeric_limits<float>::max(), origin, voxel);
}

openvdb::Vec3SGrid::Ptr velocityGrid(const py::handle& velocity, const py::handle& likePhi,
                                     const Vec3d& origin, double voxel) {
  const Floats array = floats(velocity, "velocity", 4, 3);
  checkLike(array, "velocity", likePhi);
  // Velocities of the background's value would count as unknown.
  return gridOf<openvdb::Vec3SGrid>(array, Vec3f(std::numeric_limits<float>::max()), origin, voxel);
}

openvdb::FloatGrid::Ptr scalarGrid(const py::handle& values, const std::string& name,
                                   const py::handle& likePhi, const Vec3d& origin, double voxel) {
  const Floats array = floats(values, name, 3);
  checkLike(array, name, likePhi);
  return gridOf<openvdb::FloatGrid>(array, 0.0f, origin, voxel);
}

std::vector<Vec3f> vectors(const py::handle& value, const std::string& name) {
  const Floats array = floats(value, name, 2, 3);
  std::vector<Vec3f> result(std::size_t(array.shape(0)));
  if (!result.empty())
    std::memcpy(static_cast<void*>(result.data()), array.data(), result.size() * sizeof(Vec3f));
  return result;
}

std::vector<Vec3I> triangles(const py::handle& value, std::size_t points) {
  const py::array given = anyArray(value, "triangles");
  const char kind = given.dtype().kind();
  if ((kind != 'i' && kind != 'u') || given.ndim() != 2 || given.shape(1) != 3)
    throw std::invalid_argument(
        fmt::format("triangles: is {} of kind {}; give whole numbers, n x 3", shapeOf(given), kind));
  const auto array = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(given);
  const auto corner = array.unchecked<2>();
  std::vector<Vec3I> result;
  result.reserve(std::size_t(array.shape(0)));
  for (py::ssize_t n = 0; n < array.shape(0); ++n) {
    for (int c = 0; c < 3; ++c)
      if (corner(n, c) < 0 || std::size_t(corner(n, c)) >= points)
        throw std::invalid_argument(fmt::format(
            "triangles: number {} has vertex {}; there are {}, counted from 0", n, corner(n, c), points));
    result.emplace_back(std::uint32_t(corner(n, 0)), std::uint32_t(corner(n, 1)),
                        std::uint32_t(corner(n, 2)));
  }
  return result;
}

texture::Image picture(const py::handle& value) {
  const py::array given = anyArray(value, "exemplar");
  const bool bytes = given.dtype().kind() == 'u' && given.itemsize() == 1;
  if ((!bytes && given.dtype().kind() != 'f') || given.ndim() < 2 || given.ndim() > 3 ||
      (given.ndim() == 3 && given.shape(2) != 3 && given.shape(2) != 4))
    throw std::invalid_argument(
        fmt::format("exemplar: is {} of {}; give height x width x 3 or 4, uint8 (sRGB) or float (linear)",
                    shapeOf(given), std::string(py::str(given.dtype()))));
  const Floats array = floats(value, "exemplar", int(given.ndim()));
  const int channels = array.ndim() == 3 ? int(array.shape(2)) : 1;
  texture::Image image{int(array.shape(1)), int(array.shape(0)), 4, {}};
  const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
  image.data.resize(4 * count);
  const float* from = array.data();
  const auto linear = [&](float number) { return bytes ? texture::decodeSrgb(number / 255.0f) : number; };
  for (std::size_t n = 0; n < count; ++n, from += channels) {
    float* to = image.data.data() + 4 * n;
    for (int c = 0; c < 3; ++c) to[c] = linear(from[channels == 1 ? 0 : c]);
    to[3] = channels == 4 ? (bytes ? from[3] / 255.0f : from[3]) : 1.0f;
  }
  return image;
}

py::dict arraysOf(const texture::TexturedSurface& surface, std::optional<bool> toroidal) {
  const texture::Torus exemplar(surface, toroidal.value_or(false));
  const auto width = float(surface.exemplarWidth), height = float(surface.exemplarHeight);
  py::dict result;
  result["vertices"] = vectorColumns(surface.positions);
  result["triangles"] = columns<std::uint32_t>(surface.triangles, {3});
  result["normals"] = vectorColumns(surface.normals);
  result["color"] = columns<float>(surface.color, {4});
  result["st"] = places(surface.coordinate, exemplar, toroidal.has_value());
  result["st_gradient"] = slopes(surface.gradient, width, height);
  result["fade_st"] = places(surface.fading.coordinate, exemplar, toroidal.has_value());
  result["fade"] = columns<float>(surface.fading.weight, {});
  result["orientation"] = vectorColumns(surface.orientation);
  result["previous"] = vectorColumns(surface.previousPosition);
  result["velocity"] = vectorColumns(surface.velocity);
  result["trust"] = columns<float>(surface.trust, {});
  result["age"] = columns<float>(surface.age, {});
  if (!surface.scale.empty()) result["scale"] = columns<float>(surface.scale, {});
  py::dict maps;
  for (const auto& [name, values] : surface.maps) maps[py::str(name)] = columns<float>(values, {});
  for (const auto& [name, values] : surface.vectors) maps[py::str(name)] = vectorColumns(values);
  result["maps"] = maps;
  return result;
}

}  // namespace fluidtex::python
