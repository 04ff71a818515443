// The Python module fluidtex.
#include "caches/liquid/level_set.h"
#include "pipeline/given_flow.h"
#include "pipeline/texture_frame.h"
#include "python/arrays.h"
#include "scenes/source.h"
#include "sim/meshes/read_mesh.h"
#include "texture/joints/cut.h"

#include <fmt/core.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

namespace fluidtex::python {
namespace {

using namespace py::literals;
using openvdb::Vec3d;

constexpr const char* kModule =
    R"(Texture that is synthesized from one example image, on the moving surface of a liquid.

A Texturer takes the liquid frame by frame, as arrays, and gives the textured surface of each::

    import fluidtex
    texturer = fluidtex.Texturer("scales.png", spacing=0.01)
    for phi, u in frames:
        mesh = texturer.frame(phi=phi, velocity=u, origin=(0, 0, 0), voxel=0.02, dt=1/24)
        mesh["vertices"], mesh["triangles"], mesh["color"], mesh["st"]

Units are metres, seconds and m/s; axes are right-handed, and z is up. The same input gives the same
numbers on any number of threads. Bad input raises ValueError.)";

constexpr const char* kTexturer =
    R"(Texturer(exemplar, *, spacing=None, points=None, toroidal=False, settings="")

The texture of one liquid, carried from frame to frame.

exemplar: the picture that the texture is made of, 33 pixels a side or more: the name of a file, or an
    array, height x width x 3 or 4, of uint8 (sRGB) or floats (linear, straight alpha).
spacing: distance of neighbouring points, metres, the side of one of the exemplar's pixels. None: such
    that the first surface gets `points` points.
points: how many, 40000 by default. Time grows with them.
toroidal: the picture's left edge continues at its right one, and its top at its bottom.
settings: all else, as the text of a scene file, with keys of [texture], [texture.orientation],
    [texture.guidance], ...: "texture.coherence = 0.8". scenes/README.md lists them. File names in it
    begin in the current folder.)";

constexpr const char* kFrame =
    R"(frame(*, phi=None, vertices=None, triangles=None, velocity=None, origin=(0, 0, 0), voxel=None,
      dt=1/24, fields={}, cut=False) -> dict

Textures the next frame. The surface is one of:

phi: nx x ny x nz numbers, negative inside, at origin + voxel * (i, j, k); positive on all outer faces.
vertices, triangles: a closed mesh, n x 3 floats and m x 3 whole numbers from 0. voxel is then the side
    of the cells of the level set that is made of it; None: the mean edge.

velocity: of the liquid in this frame, m/s: nx x ny x nz x 3 with phi, at the same places; n x 3 with a
    mesh. It is needed where the surface is and where it goes until the next frame. None: unknown, and
    the frame before or after has the say; where neither has, the liquid rests.
dt: s since the last frame.
fields: further scalars of the liquid by name, such as {"temperature": T}: nx x ny x nz with phi, n with
    a mesh. Settings can name them ([texture.guidance], [texture.scale], [texture.renewal]);
    they come back in maps.
cut: cuts triangles whose corners show different pieces of the exemplar, so that st can be interpolated
    within every one.

Returns a dict of arrays, n rows for n points:

vertices, normals (n x 3); triangles (m x 3, counter-clockwise seen from outside)
color (n x 4): linear RGBA, straight alpha
st (n x 2): place in the exemplar, 0..1 from the top left corner; without cut it jumps between pieces
st_gradient (n x 2 x 3): gradient of s and t in space, 1/m, along the surface
fade_st (n x 2), fade (n): the place that was shown before, and how much of it is left, 1 to 0
orientation (n x 3): unit, tangent, along the exemplar's rows
previous (n x 3): where the point was a frame ago
velocity (n x 3), trust (n, 0..1), age (n, s since it was renewed), scale (n, with [texture.scale])
maps: a dict of the settings' further maps and of the fields, n or n x 3 each
renewed: share of the points that show another place than what was carried to them; 1 in the first frame,
    unless it begins with a mesh's texture ([texture.start])
explained: share of the surface's motion that the velocities explain, or None where little moves
spacing: metres

If it raises, the last frame stays the last one.)";

// In the current folder, as settings name files.
scenes::Scene sceneOf(const py::object& exemplar, bool inMemory, const std::optional<double>& spacing,
                      const std::optional<int>& points, bool toroidal, const std::string& settings) {
  scenes::Overrides overrides;
  overrides.liquidOnly = inMemory;
  // Its liquid comes frame by frame, as that of other programs does.
  overrides.set = {"motion.flow=files", "files.path=."};
  if (toroidal) overrides.set.emplace_back("texture.toroidal=true");
  if (spacing) overrides.set.push_back(fmt::format("texture.spacing={}", *spacing));
  if (points) overrides.set.push_back(fmt::format("texture.points={}", *points));
  if (!inMemory) overrides.exemplar = py::str(exemplar).cast<std::string>();
  return scenes::loadScene({"settings", settings}, overrides);
}

bool isName(const py::object& exemplar) {
  return py::isinstance<py::str>(exemplar) || py::hasattr(exemplar, "__fspath__");
}

pipeline::Texturing texturingOf(const py::object& exemplar, const std::optional<double>& spacing,
                                const std::optional<int>& points, bool toroidal,
                                const std::string& settings) {
  if (spacing && points)
    throw std::invalid_argument(
        "spacing: is given, and points too, of which one follows from the other; give one");
  if (spacing && !(*spacing > 0.0 && std::isfinite(*spacing)))
    throw std::invalid_argument(fmt::format("spacing: is {}; give metres, more than 0", *spacing));
  if (points && *points < 1)
    throw std::invalid_argument(fmt::format("points: is {}; give how many, more than 0", *points));
  const bool inMemory = !isName(exemplar);
  const scenes::Scene scene = sceneOf(exemplar, inMemory, spacing, points, toroidal, settings);
  if (!inMemory) {
    const py::gil_scoped_release free;
    return pipeline::makeTexturing(scene);
  }
  texture::Image image = picture(exemplar);
  const py::gil_scoped_release free;
  return pipeline::makeTexturing(
      scene, texture::makeExemplar(std::move(image), scene.texture.exemplar.toroidal, scene.texture.synthesis,
                                   scene.texture.surface.levels));
}

class Texturer {
 public:
  Texturer(const py::object& exemplar, const std::optional<double>& spacing, const std::optional<int>& points,
           bool toroidal, const std::string& settings)
      : m_texturing(texturingOf(exemplar, spacing, points, toroidal, settings)) {}

  py::dict frame(const py::object& phi, const py::object& vertices, const py::object& triangles,
                 const py::object& velocity, const std::array<double, 3>& origin,
                 const std::optional<double>& voxel, double dt,
                 const std::map<std::string, py::object>& fields, bool cut) {
    if (!(dt > 0.0 && std::isfinite(dt)))
      throw std::invalid_argument(fmt::format("dt: is {}; give seconds, more than 0", dt));
    if (voxel && !(*voxel > 0.0 && std::isfinite(*voxel)))
      throw std::invalid_argument(fmt::format("voxel: is {}; give metres, more than 0", *voxel));
    if (phi.is_none() == vertices.is_none())
      throw std::invalid_argument("phi, vertices: give one of them, and triangles with vertices");
    const std::function<caches::LiquidFrame()> liquid =
        phi.is_none() ? ofMesh(vertices, triangles, velocity, voxel, dt, fields)
                      : ofGrid(phi, velocity, origin, voxel, fields);
    pipeline::TexturedFrame result;
    std::optional<double> explained;
    texture::TexturedSurface parts;
    {
      const py::gil_scoped_release free;
      const std::lock_guard<std::mutex> one(m_mutex);
      pipeline::GivenFlow flow = m_flow;
      const sim::Frame motion = flow.next(liquid(), dt);
      explained = motion.stats.explained;
      m_texturing.scene.sim.frameRate = 1.0 / dt;
      result = pipeline::textureFrame(m_texturing, m_last, motion, {.progress = mayStop});
      if (cut) parts = texture::cutAtJoints(result.surface, isToroidal()).surface;
      m_flow = std::move(flow);
      m_last = result.surface;
    }
    // A triangle of a cut surface may lie across the exemplar's edge.
    py::dict arrays = cut ? arraysOf(parts, {}) : arraysOf(result.surface, isToroidal());
    arrays["renewed"] = result.synthesis.renewed;
    arrays["explained"] = explained;
    arrays["spacing"] = result.surface.spacing;
    return arrays;
  }

  std::pair<int, int> size() const {
    const texture::Image& color = m_texturing.synthesizer.exemplar.color;
    return {color.width, color.height};
  }

 private:
  // Ctrl-C.
  static void mayStop(pipeline::Stage, double) {
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

  bool isToroidal() const { return m_texturing.synthesizer.exemplar.toroidal; }

  // What is made of the arrays without Python's lock.
  using MakeLiquid = std::function<caches::LiquidFrame()>;
  using Fields = std::map<std::string, py::object>;

  static MakeLiquid ofGrid(const py::object& phi, const py::object& velocity,
                           const std::array<double, 3>& origin, const std::optional<double>& voxel,
                           const Fields& fields) {
    if (!voxel) throw std::invalid_argument("voxel: is missing; give the distance of phi's values, metres");
    const Vec3d corner(origin[0], origin[1], origin[2]);
    const openvdb::FloatGrid::Ptr surface = levelSet(phi, corner, *voxel);
    const openvdb::Vec3SGrid::Ptr moves =
        velocity.is_none() ? nullptr : velocityGrid(velocity, phi, corner, *voxel);
    std::map<std::string, sim::FloatGrid::ConstPtr> scalars;
    for (const auto& [name, values] : fields)
      scalars[name] = sim::fromOpenVdb(*scalarGrid(values, "fields: " + name, phi, corner, *voxel));
    return [=] {
      caches::LiquidFrame frame = pipeline::liquidOf(*surface, moves);
      frame.fields = scalars;
      return frame;
    };
  }

  static MakeLiquid ofMesh(const py::object& points, const py::object& corners, const py::object& velocity,
                           const std::optional<double>& voxel, double dt, const Fields& fields) {
    if (corners.is_none()) throw std::invalid_argument("triangles: are missing; give them with vertices");
    caches::SurfaceTriangles mesh{vectors(points, "vertices"), {}};
    mesh.triangles = triangles(corners, mesh.points.size());
    const auto check = [&](const std::string& name, std::size_t count) {
      if (count != mesh.points.size())
        throw std::invalid_argument(fmt::format("{}: there are {}, and {} vertices; give one for each", name,
                                                count, mesh.points.size()));
    };
    std::vector<openvdb::Vec3f> moves;
    if (!velocity.is_none()) {
      moves = vectors(velocity, "velocity");
      check("velocity", moves.size());
    }
    std::map<std::string, std::vector<float>> scalars;
    for (const auto& [name, values] : fields) {
      const Floats array = floats(values, "fields: " + name, 1);
      scalars[name].assign(array.data(), array.data() + array.size());
      check("fields: " + name, scalars[name].size());
    }
    const double h = voxel.value_or(mesh.triangles.empty() ? 1.0 : caches::meanEdge(mesh));
    return [=] {
      caches::LiquidFrame frame = pipeline::liquidOf(mesh, moves, h, dt);
      if (scalars.empty()) return frame;
      caches::ClosestTriangles closest(frame.surface, h);
      for (const auto& [name, values] : scalars)
        frame.fields[name] = sim::fromOpenVdb(*caches::continuedOff(closest, values, 1, caches::kBand)[0]);
      return frame;
    };
  }

  pipeline::Texturing m_texturing;
  pipeline::GivenFlow m_flow;
  texture::TexturedSurface m_last;
  std::mutex m_mutex;
};

constexpr const char* kTexture =
    R"(texture(exemplar, *, spacing=None, points=None, toroidal=False, settings="", **frame) -> dict

Textures one surface: Texturer(exemplar, ...).frame(...), with the arguments of both.)";

py::dict textureOnce(const py::object& exemplar, const std::optional<double>& spacing,
                     const std::optional<int>& points, bool toroidal, const std::string& settings,
                     const py::kwargs& frame) {
  const py::object texturer =
      py::cast(std::make_unique<Texturer>(exemplar, spacing, points, toroidal, settings));
  return texturer.attr("frame")(**frame);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 calls it so.
void asValueError(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const scenes::SceneError& fault) {
    PyErr_SetString(PyExc_ValueError, fault.what());
  } catch (const texture::ExemplarError& fault) {
    PyErr_SetString(PyExc_ValueError, fault.what());
  } catch (const sim::MeshError& fault) {
    PyErr_SetString(PyExc_ValueError, fault.what());
  }
}

}  // namespace

PYBIND11_MODULE(fluidtex, module) {
  openvdb::initialize();
  py::register_local_exception_translator(asValueError);
  py::options options;
  options.disable_function_signatures();
  module.doc() = kModule;
  module.attr("__version__") = FLUIDTEX_VERSION;
  py::class_<Texturer>(module, "Texturer", kTexturer)
      .def(py::init<const py::object&, const std::optional<double>&, const std::optional<int>&, bool,
                    const std::string&>(),
           "exemplar"_a, py::kw_only(), "spacing"_a = py::none(), "points"_a = py::none(),
           "toroidal"_a = false, "settings"_a = "")
      .def("frame", &Texturer::frame, kFrame, py::kw_only(), "phi"_a = py::none(), "vertices"_a = py::none(),
           "triangles"_a = py::none(), "velocity"_a = py::none(),
           "origin"_a = std::array<double, 3>{0.0, 0.0, 0.0}, "voxel"_a = py::none(), "dt"_a = 1.0 / 24.0,
           "fields"_a = py::dict(), "cut"_a = false)
      .def_property_readonly(
          "size", [](const Texturer& made) { return py::make_tuple(made.size().first, made.size().second); },
          "Width and height of the exemplar, texels.");
  module.def("texture", &textureOnce, kTexture, "exemplar"_a, py::kw_only(), "spacing"_a = py::none(),
             "points"_a = py::none(), "toroidal"_a = false, "settings"_a = "");
}

}  // namespace fluidtex::python
